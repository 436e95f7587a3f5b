#include "selection/cut.h"

#include "core/check.h"

#include <algorithm>
#include <limits>
#include <map>

namespace gnomon::selection {
namespace {

using hierarchy::kNone;
using hierarchy::PageDemand;

/// Each page once, with the most pixels that anyone gave it, by id.
void unite(std::vector<PageDemand>& demands) {
    std::sort(demands.begin(), demands.end(), [](const PageDemand& a, const PageDemand& b) {
        return a.page != b.page ? a.page < b.page : a.pixels > b.pixels;
    });
    const auto samePage = [](const PageDemand& a, const PageDemand& b) { return a.page == b.page; };
    demands.erase(std::unique(demands.begin(), demands.end(), samePage), demands.end());
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

} // namespace

PageTrees::PageTrees(std::span<const hierarchy::PageInfo> pages, const hierarchy::Grid& grid) : grid_(grid) {
    std::map<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> byLevel;
    for (std::uint32_t page = 0; page < pages.size(); ++page)
        byLevel[pages[page].level].push_back(page);
    for (const auto& [level, ids] : byLevel) {
        Level& result = levels_.emplace_back();
        std::vector<bvh::Item> items;
        for (const std::uint32_t page : ids) {
            const hierarchy::PageInfo& info = pages[page];
            items.push_back({grid.local(info.box), info.bounds, info.maxError});
            result.items.push_back({page, info.maxError == std::numeric_limits<double>::infinity()});
        }
        result.tree = bvh::Tree(items);
    }
}

std::vector<PageVisit> visitedPages(const CutQuery& query, std::vector<std::uint32_t>& missingRoots) {
    const std::uint64_t mine = bvh::undecidedMask(query.volumes.size()).touching;
    std::vector<ConvexVolume> volumes(query.volumes.begin(), query.volumes.end());
    volumes.emplace_back(); // all of space: the rule alone says which pages are in demand
    std::vector<PageVisit> visits;
    const auto matters = [&](const Sphere& bounds, double error) {
        return query.rule->pixels(bounds, error) > query.errorPixels;
    };
    for (const PageTrees::Level& level : query.trees->levels()) {
        bvh::traverse(level.tree, volumes, matters, [&](std::uint32_t item, bvh::VolumeMask mask) {
            const PageTrees::PageItem& found = level.items[item];
            if (query.resident[found.page] != nullptr) {
                visits.push_back({found.page, {mask.touching & mine, mask.inside & mine}, found.holdsRoot});
            } else if (found.holdsRoot) {
                missingRoots.push_back(found.page);
            }
        });
    }
    return visits;
}

CutPart::CutPart(const CutQuery& query) : query_(&query), lists_(query.volumes.size()) {}

void CutPart::add(const PageVisit& visit) {
    const hierarchy::Page& page = *query_->resident[visit.page];
    if (visit.holdsRoot) used_.push_back({visit.page, std::numeric_limits<double>::infinity()});
    test(page);
    if (visit.mask.touching == 0) return;
    for (const hierarchy::Group& group : page.groups)
        if (query_->rule->pixels(group.bounds, group.error) > query_->errorPixels) addGroup(page, group, visit);
    flush();
    groupsTested_ += page.groups.size();
}

void CutPart::test(const hierarchy::Page& page) {
    refinements_.resize(page.refinements.size());
    for (std::size_t i = 0; i < page.refinements.size(); ++i) {
        const hierarchy::Refinement& refinement = page.refinements[i];
        const double pixels = query_->rule->pixels(refinement.bounds, refinement.error);
        const bool isAsked = pixels > query_->errorPixels;
        const bool isResident = query_->resident[refinement.group.page] != nullptr;
        refinements_[i] = {pixels, isAsked && isResident};
        if (isAsked) (isResident ? used_ : wanted_).push_back({refinement.group.page, pixels});
    }
}

void CutPart::addGroup(const hierarchy::Page& page, const hierarchy::Group& group, const PageVisit& visit) {
    const hierarchy::Grid& grid = query_->trees->grid();
    const auto narrowed = [&](bvh::VolumeMask mask, const hierarchy::GridBox& box) {
        return mask.undecided() == 0 ? mask : bvh::narrowed(mask, query_->volumes, grid.local(box));
    };
    const bvh::VolumeMask groupMask = narrowed(visit.mask, group.box);
    if (groupMask.touching == 0) return;
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
        const hierarchy::Cluster& cluster = page.clusters[c];
        const std::uint64_t touching = narrowed(groupMask, cluster.box).touching;
        if (touching == 0) continue;
        if (cluster.refinement != kNone) {
            const RefinementState& state = refinements_[cluster.refinement];
            if (state.isRefined) continue;
            if ((touching & 1U) != 0) achieved_ = std::max(achieved_, state.pixels);
        }
        draw(visit.page, c, cluster.triangleCount, touching);
    }
}

void CutPart::draw(std::uint32_t page, std::uint32_t cluster, std::uint32_t triangles, std::uint64_t touching) {
    const bool continues = run_.range.clusterCount != 0 && run_.touching == touching &&
                           run_.range.firstCluster + run_.range.clusterCount == cluster;
    if (!continues) {
        flush();
        run_ = {{page, cluster, 0}, touching, 0};
    }
    ++run_.range.clusterCount;
    run_.triangles += triangles;
}

void CutPart::flush() {
    if (run_.range.clusterCount == 0) return;
    for (std::uint64_t left = run_.touching; left != 0; left &= left - 1) {
        DrawList& list = lists_[static_cast<std::size_t>(std::countr_zero(left))];
        list.ranges.push_back(run_.range);
        list.clusters += run_.range.clusterCount;
        list.triangles += run_.triangles;
    }
    run_ = {};
}

Cut CutPart::joined(
    const CutQuery& query, std::span<const CutPart> parts, std::span<const std::uint32_t> missingRoots) {
    Cut result;
    result.lists.resize(query.volumes.size());
    result.errorPixels = query.errorPixels;
    for (const CutPart& part : parts) {
        for (std::size_t list = 0; list < result.lists.size(); ++list) {
            append(result.lists[list].ranges, part.lists_[list].ranges);
            result.lists[list].clusters += part.lists_[list].clusters;
            result.lists[list].triangles += part.lists_[list].triangles;
        }
        append(result.used, part.used_);
        append(result.wanted, part.wanted_);
        result.achievedErrorPixels = std::max(result.achievedErrorPixels, part.achieved_);
        result.groupsTested += part.groupsTested_;
    }
    for (const std::uint32_t page : missingRoots) {
        result.wanted.push_back({page, std::numeric_limits<double>::infinity()});
        result.achievedErrorPixels = std::numeric_limits<double>::infinity();
    }
    unite(result.used);
    unite(result.wanted);
    return result;
}

std::vector<PageDemand> demand(const CutQuery& query) {
    CutQuery anywhere = query;
    anywhere.volumes = {};
    Cut result = cut(anywhere);
    append(result.used, result.wanted);
    return std::move(result.used);
}

Cut cut(const CutQuery& query) {
    std::vector<std::uint32_t> missingRoots;
    CutPart part(query);
    for (const PageVisit& visit : visitedPages(query, missingRoots))
        part.add(visit);
    return CutPart::joined(query, {&part, 1}, missingRoots);
}

} // namespace gnomon::selection
