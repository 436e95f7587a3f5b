#include "render/lod_substitutes.h"

#include <algorithm>
#include <tuple>

namespace gnomon::render {

namespace {

auto place(const LodSubstitute& substitute) {
    return std::tuple(substitute.page, substitute.cluster);
}

} // namespace

std::vector<LodSubstitute> lodSubstitutes(
    const lod::CutQuery& query, const lod::DrawList& image, const std::function<bool(std::uint32_t page)>& isDamaged) {
    std::vector<LodSubstitute> result;
    for (const lod::ClusterRange& range : image.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const std::uint32_t finer = page.clusters[c].refinement;
            if (finer == hierarchy::kNone) continue;
            const hierarchy::Refinement& refinement = page.refinements[finer];
            if (!query.rule->exceeds(refinement.bounds, refinement.drawnError(), query.errorPixels)) continue;
            const bool isBlocked = query.blocked != nullptr && query.blocked->contains(refinement.group);
            const bool isLost = isBlocked || isDamaged(refinement.group.page);
            result.push_back({range.page, c, isLost ? Residence::Damaged : Residence::Pending});
        }
    }
    std::sort(result.begin(), result.end(), [](const LodSubstitute& a, const LodSubstitute& b) {
        return place(a) < place(b);
    });
    return result;
}

Residence residenceOf(std::span<const LodSubstitute> substitutes, std::uint32_t page, std::uint32_t cluster) {
    const std::tuple wanted(page, cluster);
    const auto found =
        std::lower_bound(substitutes.begin(), substitutes.end(), wanted, [](const LodSubstitute& a, const auto& b) {
            return place(a) < b;
        });
    return found != substitutes.end() && place(*found) == wanted ? found->residence : Residence::Final;
}

lod::DrawList drawnAs(
    const lod::DrawList& image,
    std::span<const LodSubstitute> substitutes,
    Residence residence,
    const PageLookup& pages) {
    lod::DrawList result;
    for (const lod::ClusterRange& range : image.ranges)
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (residenceOf(substitutes, range.page, c) != residence) continue;
            result.ranges.push_back({range.page, c, 1});
            ++result.clusters;
            result.triangles += pages(range.page).clusters[c].triangleCount;
        }
    return result;
}

} // namespace gnomon::render
