// What of the bytes that a picture reads it draws: pages, refined groups, drawn clusters.
// page_bytes MODEL.gnm [ERROR_PIXELS] [DISTANCE]: seen from that many diagonals away, without shadows, 800 pixels high.
#include "core/camera.h"
#include "hierarchy/cut_rule.h"
#include "hierarchy/model_file.h"
#include "selection/error_rule.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

namespace gnomon {
namespace {

/// Of stored bytes: a page's are its clusters' by their triangles.
struct Shares {
    double tables = 0;
    double pages = 0;        // that hold what is refined, or that such a page refines
    double refinedPages = 0; // that hold what is refined
    double groups = 0;
    double clusters = 0;
    double triangles = 0;
    std::uint64_t requests = 0;
};

class Count {
public:
    Count(const hierarchy::ModelFile& file, double errorPixels, double distance)
        : file_(file), errorPixels_(errorPixels), isNeeded_(file.pages().size()) {
        const hierarchy::ModelSummary& summary = file.summary();
        const double size = glm::length(summary.bounds.extent());
        Camera camera;
        camera.target = summary.bounds.center() - summary.grid.origin;
        camera.eye = camera.target + glm::normalize(glm::dvec3(0.5, 0.35, 1)) * (distance * size);
        view_.eye = camera.eye;
        view_.basis = cameraBasis(camera);
        view_.nearestDepth = 1e-3 * size;
        rule_ = std::make_unique<selection::ErrorRule>(view_);
    }

    Shares run() {
        Shares sum;
        std::vector<std::uint8_t> isRefined(isNeeded_.size());
        const ConvexVolume pyramid = selection::viewPyramid(view_);
        for (std::uint32_t p = 0; p < isNeeded_.size(); ++p) {
            const hierarchy::Page page = file_.readPage(p);
            const hierarchy::PageInfo& info = file_.pages()[p];
            sum.tables += 112 + 4.0 * static_cast<double>(info.children.size());
            const double each = double(info.storedBytes) / info.triangleCount;
            for (const hierarchy::Group& group : page.groups) {
                if (group.error < std::numeric_limits<double>::infinity() && !refines(group.drawnError(), group.bounds))
                    continue;
                isRefined[p] = 1;
                for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
                    sum.groups += each * page.clusters[c].triangleCount;
            }
            hierarchy::forEachDrawn(
                page,
                [this](double error, const Sphere& bounds) { return refines(error, bounds); },
                [&](const hierarchy::Group&, const hierarchy::Cluster& cluster) {
                    if (classify(pyramid, file_.summary().grid.local(cluster.box)) == Containment::Outside) return;
                    sum.clusters += each * cluster.triangleCount;
                    sum.triangles += cluster.triangleCount;
                });
        }
        for (std::size_t p = isNeeded_.size(); p-- > 0;) {
            const hierarchy::PageInfo& info = file_.pages()[p];
            isNeeded_[p] = isRefined[p];
            for (const std::uint32_t child : info.children)
                isNeeded_[p] |= isNeeded_[child];
            if (isRefined[p] != 0) sum.refinedPages += info.storedBytes;
            if (isNeeded_[p] == 0) continue;
            sum.pages += info.storedBytes;
            ++sum.requests;
        }
        return sum;
    }

private:
    bool refines(double error, const Sphere& bounds) const { return rule_->exceeds(bounds, error, errorPixels_); }

    const hierarchy::ModelFile& file_;
    double errorPixels_;
    std::vector<std::uint8_t> isNeeded_;
    selection::DetailView view_;
    std::unique_ptr<selection::ErrorRule> rule_;
};

int run(int argc, char** argv) {
    const hierarchy::ModelFile file(argv[1]);
    const Shares sum = Count(file, argc > 2 ? std::atof(argv[2]) : 1, argc > 3 ? std::atof(argv[3]) : 1).run();
    std::printf(
        "%zu pages of %.1f MB, table %.2f MB; read %llu pages, MB as stored: %.2f; of these drawn clusters (%.0f "
        "triangles) %.2f, refined groups above them %.2f, other groups in these pages %.2f, pages of which nothing is "
        "refined %.2f; read / drawn %.2f\n",
        file.pages().size(),
        double(file.fileBytes()) / 1e6,
        sum.tables / 1e6,
        static_cast<unsigned long long>(sum.requests),
        sum.pages / 1e6,
        sum.triangles,
        sum.clusters / 1e6,
        (sum.groups - sum.clusters) / 1e6,
        (sum.refinedPages - sum.groups) / 1e6,
        (sum.pages - sum.refinedPages) / 1e6,
        sum.pages / sum.clusters);
    return 0;
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    return gnomon::run(argc, argv);
}
