#include "executor/stand_ins.h"

#include <algorithm>
#include <tuple>

namespace gnomon::executor {

namespace {

auto place(const StandIn& standIn) {
    return std::tuple(standIn.page, standIn.cluster);
}

} // namespace

std::vector<StandIn> standIns(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    const std::function<bool(std::uint32_t page)>& isDamaged) {
    std::vector<StandIn> result;
    for (const selection::ClusterRange& range : image.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const std::uint32_t finer = page.clusters[c].refinement;
            if (finer == hierarchy::kNone) continue;
            const hierarchy::Refinement& refinement = page.refinements[finer];
            if (!query.rule->exceeds(refinement.bounds, refinement.error, query.errorPixels)) continue;
            const bool isBlocked = query.blocked != nullptr && query.blocked->contains(refinement.group);
            const bool isLost = isBlocked || isDamaged(refinement.group.page);
            result.push_back({range.page, c, isLost ? Residence::Damaged : Residence::Awaited});
        }
    }
    std::sort(result.begin(), result.end(), [](const StandIn& a, const StandIn& b) { return place(a) < place(b); });
    return result;
}

Residence residenceOf(std::span<const StandIn> standIns, std::uint32_t page, std::uint32_t cluster) {
    const std::tuple wanted(page, cluster);
    const auto found = std::lower_bound(
        standIns.begin(), standIns.end(), wanted, [](const StandIn& a, const auto& b) { return place(a) < b; });
    return found != standIns.end() && place(*found) == wanted ? found->residence : Residence::AsAsked;
}

selection::DrawList drawnAs(
    const selection::DrawList& image, std::span<const StandIn> standIns, Residence residence, const PageLookup& pages) {
    selection::DrawList result;
    for (const selection::ClusterRange& range : image.ranges)
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (residenceOf(standIns, range.page, c) != residence) continue;
            result.ranges.push_back({range.page, c, 1});
            ++result.clusters;
            result.triangles += pages(range.page).clusters[c].triangleCount;
        }
    return result;
}

} // namespace gnomon::executor
