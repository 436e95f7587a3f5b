#include "preprocess/verify/uniform_cut.h"

#include "hierarchy/cut_rule.h"

#include <algorithm>

namespace gnomon::verify {

using namespace hierarchy;

const UniformCut::Part& UniformCut::partOf(std::uint32_t triangle) const {
    const auto after = std::upper_bound(
        parts.begin(), parts.end(), triangle, [](std::uint32_t t, const Part& part) { return t < part.firstTriangle; });
    return *(after - 1);
}

UniformCut uniformCut(const LoadedModel& model, double limit) {
    UniformCut cut;
    const auto isRefined = [limit](double error, const Sphere&) { return error > limit; };
    for (std::uint32_t p = 0; p < model.pages.size(); ++p) {
        const Page& page = model.pages[p];
        forEachDrawn(page, isRefined, [&](const Group&, const Cluster& cluster) {
            const auto index = static_cast<std::uint32_t>(&cluster - page.clusters.data());
            cut.parts.push_back({p, index, static_cast<std::uint32_t>(cut.soup.triangles.size())});
            const auto first = static_cast<std::uint32_t>(cut.soup.positions.size());
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
                cut.soup.positions.push_back(model.summary.grid.local(page.vertices[cluster.firstVertex + v].position));
            for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
                const Triangle& triangle = page.triangles[cluster.firstTriangle + t];
                cut.soup.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
            }
        });
    }
    return cut;
}

std::vector<double> boundsInCut(const LoadedModel& model, double limit) {
    std::vector<double> bounds(model.firstGroup.back(), 0);
    // Pages are sorted from coarse to fine. The bound of a group is therefore complete before the loop passes it on to
    // the group's finer groups.
    for (std::size_t p = 0; p < model.pages.size(); ++p) {
        const Page& page = model.pages[p];
        for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
            const Group& group = page.groups[g];
            const bool isRefined = group.drawnError() > limit;
            double& bound = bounds[model.firstGroup[p] + g];
            bound = isRefined ? 0 : std::max(bound, group.error);
            if (isRefined) continue;
            for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
                const std::uint32_t refinement = page.clusters[group.firstCluster + c].refinement;
                if (refinement == kNone) continue;
                double& finer = bounds[model.groupNumber(page.refinements[refinement].group)];
                finer = std::max(finer, bound);
            }
        }
    }
    return bounds;
}

} // namespace gnomon::verify
