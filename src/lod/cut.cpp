#include "lod/cut.h"

#include "core/check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace gnomon::lod {
namespace {

using hierarchy::kNone;
using hierarchy::PageDemand;

/// Merges demands for the same page, like `unite`, with an array over the ids `first` to `last`. This range must be
/// small.
void uniteByPlace(std::vector<PageDemand>& demands, std::uint32_t first, std::uint32_t last) {
    constexpr double kNobody = -1;
    std::vector<double> pixels(std::size_t{last} - first + 1, kNobody);
    for (const PageDemand& demand : demands)
        pixels[demand.page - first] = std::max(pixels[demand.page - first], demand.pixels);
    demands.clear();
    for (std::uint32_t page = first; page <= last; ++page)
        if (pixels[page - first] != kNobody) demands.push_back({page, pixels[page - first]});
}

/// Merges demands for the same page: each page then occurs once, with its max number of pixels. The result is sorted by
/// page id.
void unite(std::vector<PageDemand>& demands) {
    if (demands.empty()) return;
    // scanning this number of array elements takes less time than sorting one demand
    constexpr std::size_t kPlacesADemand = 16;
    const auto byPage = [](const PageDemand& a, const PageDemand& b) { return a.page < b.page; };
    const auto [first, last] = std::minmax_element(demands.begin(), demands.end(), byPage);
    if (last->page - first->page < kPlacesADemand * demands.size()) {
        uniteByPlace(demands, first->page, last->page);
        return;
    }
    std::sort(demands.begin(), demands.end(), [](const PageDemand& a, const PageDemand& b) {
        return a.page != b.page ? a.page < b.page : a.pixels > b.pixels;
    });
    const auto samePage = [](const PageDemand& a, const PageDemand& b) { return a.page == b.page; };
    demands.erase(std::unique(demands.begin(), demands.end(), samePage), demands.end());
}

/// Returns the lists of drawn clusters for the image, the casters and `sections` section planes, in this order.
DrawLists listsByUse(std::vector<DrawList> lists, std::size_t sections) {
    DrawLists result;
    if (lists.empty()) return result;
    GNOMON_CHECK_OP(sections, <, lists.size());
    result.image = std::move(lists.front());
    const auto firstSection = lists.end() - static_cast<std::ptrdiff_t>(sections);
    result.casters.assign(std::move_iterator(lists.begin() + 1), std::move_iterator(firstSection));
    result.sections.assign(std::move_iterator(firstSection), std::move_iterator(lists.end()));
    return result;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

} // namespace

std::vector<const DrawList*> DrawLists::all() const {
    std::vector<const DrawList*> lists{&image};
    for (const DrawList& list : casters)
        lists.push_back(&list);
    for (const DrawList& list : sections)
        lists.push_back(&list);
    return lists;
}

PageTrees::PageTrees(std::span<const hierarchy::PageInfo> pages, const hierarchy::Grid& grid) : grid_(grid) {
    std::map<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> byLevel;
    for (std::uint32_t page = 0; page < pages.size(); ++page)
        byLevel[pages[page].level].push_back(page);
    for (const auto& [level, ids] : byLevel) {
        Level& result = levels_.emplace_back();
        std::vector<lod::Item> items;
        for (const std::uint32_t page : ids) {
            const hierarchy::PageInfo& info = pages[page];
            items.push_back({grid.local(info.box), info.bounds, info.maxError});
            result.items.push_back({page, info.bounds, info.maxError, std::isinf(info.maxError)});
        }
        result.tree = lod::Tree(items);
    }
}

std::vector<PageVisit> visitedPages(const CutQuery& query, std::vector<std::uint32_t>& missingRoots) {
    const std::uint64_t mine = lod::undecidedMask(query.volumes.size()).touching;
    std::vector<ConvexVolume> volumes(query.volumes.begin(), query.volumes.end());
    volumes.emplace_back(); // a volume without planes is all of space, so only the error rule selects pages
    std::vector<PageVisit> visits;
    const auto matters = [&](const Sphere& bounds, double error) {
        return query.rule->exceeds(bounds, error, query.errorPixels);
    };
    for (const PageTrees::Level& level : query.trees->levels()) {
        lod::traverse(level.tree, volumes, matters, [&](std::uint32_t item, lod::VolumeMask mask) {
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

CutPart::CutPart(const CutQuery& query)
    : query_(&query), lists_(query.volumes.size()), step_(query.trees->grid().step()) {}

void CutPart::add(const PageVisit& visit) {
    const hierarchy::Page& page = *query_->resident[visit.page];
    if (visit.holdsRoot) used_.push_back({visit.page, std::numeric_limits<double>::infinity()});
    test(page);
    if (visit.mask.touching == 0) return;
    collectPlanes(visit.mask);
    for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
        const hierarchy::Group& group = page.groups[g];
        const std::uint64_t touching = narrowed(visit.mask.touching, pagePlanes_, group.box, &groupPlanes_);
        if (touching != 0 && query_->rule->exceeds(group.bounds, group.drawnError(), query_->errorPixels) &&
            !isBlocked(visit.page, g))
            addGroup(page, group, visit.page, touching);
    }
    flush();
    groupsTested_ += page.groups.size();
}

bool CutPart::isBlocked(std::uint32_t page, std::uint32_t group) const {
    return query_->blocked != nullptr && !query_->blocked->empty() && query_->blocked->contains({page, group});
}

/// Returns true if the missing page `page` is not needed, because the cut certainly refines all its groups.
bool CutPart::isPassed(std::uint32_t page) {
    if (query_->passable.empty()) return false;
    // adjacent refinements are often in the same page
    if (asked_ != page) isAskedSkippable_ = isSkippable(*query_, page);
    asked_ = page;
    return isAskedSkippable_;
}

/// Collects the planes that the box of a page may intersect: the planes of all volumes that do not certainly contain
/// the box.
void CutPart::collectPlanes(lod::VolumeMask mask) {
    pagePlanes_.clear();
    for (std::uint64_t left = mask.undecided(); left != 0; left &= left - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(left));
        for (const Plane& plane : query_->volumes[bit].planes)
            pagePlanes_.push_back({plane.normal, plane.offset, std::uint64_t{1} << bit});
    }
}

/// Returns the volumes that `box` intersects, as a bit set (see gnomon::classify). Only volumes in the bit set
/// `touching` are tested. `planes` are the planes that intersect a box around `box`. The planes that intersect `box`
/// itself are added to `still`.
std::uint64_t CutPart::narrowed(
    std::uint64_t touching,
    std::span<const CutPlane> planes,
    const hierarchy::GridBox& box,
    std::vector<CutPlane>* still) const {
    if (still != nullptr) still->clear();
    if (planes.empty()) return touching;
    const glm::dvec3 min = glm::dvec3(box.min.x, box.min.y, box.min.z) * step_;
    const glm::dvec3 max = glm::dvec3(box.max.x, box.max.y, box.max.z) * step_;
    const BoxAgainstPlanes against(Box{min, max});
    for (const CutPlane& plane : planes) {
        const Containment how = against.classify(plane.normal, plane.offset);
        if (how == Containment::Outside) {
            touching &= ~plane.volume;
            if (touching == 0) return 0;
        } else if (still != nullptr && how == Containment::Intersecting) {
            still->push_back(plane);
        }
    }
    return touching;
}

void CutPart::addGroup(
    const hierarchy::Page& page, const hierarchy::Group& group, std::uint32_t id, std::uint64_t touching) {
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
        const hierarchy::Cluster& cluster = page.clusters[c];
        const RefinementState* finer = cluster.refinement == kNone ? nullptr : &refinements_[cluster.refinement];
        if (finer != nullptr && finer->isRefined) continue;
        clustersTested_ += static_cast<std::uint64_t>(std::popcount(touching & ~std::uint64_t{1}));
        const std::uint64_t touched = narrowed(touching, groupPlanes_, cluster.box, nullptr);
        if (touched == 0) continue;
        if (finer != nullptr && (touched & 1U) != 0) achieved_ = std::max(achieved_, shownPixels(page, cluster));
        draw(id, c, cluster.triangleCount, touched);
    }
}

/// Returns the screen-space error of a drawn cluster, in pixels. The box of the cluster gives a tighter bound than the
/// sphere of its refinement. If the refinement is not in memory, this sphere can contain the eye, and its bound is then
/// infinite.
double CutPart::shownPixels(const hierarchy::Page& page, const hierarchy::Cluster& cluster) const {
    const double pixels = refinements_[cluster.refinement].viewPixels;
    if (!(pixels > query_->errorPixels)) return pixels;
    const double error = page.refinements[cluster.refinement].drawnError();
    return std::min(pixels, query_->rule->maxViewPixels(query_->trees->grid().local(cluster.box), error));
}

void CutPart::test(const hierarchy::Page& page) {
    refinements_.resize(page.refinements.size());
    for (std::size_t i = 0; i < page.refinements.size(); ++i) {
        const hierarchy::Refinement& refinement = page.refinements[i];
        const double threshold = query_->errorPixels;
        const double view = query_->rule->viewPixels(refinement.bounds, refinement.drawnError());
        const double pixels =
            view > threshold ? view : query_->rule->casterPixels(refinement.bounds, refinement.drawnError(), threshold);
        const bool isResident = query_->resident[refinement.group.page] != nullptr;
        refinements_[i] = {view, false};
        if (!(pixels > threshold)) continue;
        refinements_[i].isRefined = (isResident || isPassed(refinement.group.page)) &&
                                    !isBlocked(refinement.group.page, refinement.group.group);
        std::vector<PageDemand>& demands = isResident ? used_ : wanted_;
        // adjacent refinements are often in the same page
        if (!demands.empty() && demands.back().page == refinement.group.page) {
            demands.back().pixels = std::max(demands.back().pixels, pixels);
        } else {
            demands.push_back({refinement.group.page, pixels});
        }
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
    std::vector<DrawList> lists(query.volumes.size());
    result.errorPixels = query.errorPixels;
    for (const CutPart& part : parts) {
        for (std::size_t list = 0; list < lists.size(); ++list) {
            append(lists[list].ranges, part.lists_[list].ranges);
            lists[list].clusters += part.lists_[list].clusters;
            lists[list].triangles += part.lists_[list].triangles;
        }
        append(result.used, part.used_);
        append(result.wanted, part.wanted_);
        result.achievedErrorPixels = std::max(result.achievedErrorPixels, part.achieved_);
        result.groupsTested += part.groupsTested_;
        result.clustersTested += part.clustersTested_;
    }
    for (const std::uint32_t page : missingRoots) {
        result.wanted.push_back({page, std::numeric_limits<double>::infinity()});
        result.achievedErrorPixels = std::numeric_limits<double>::infinity();
    }
    result.lists = listsByUse(std::move(lists), query.sectionVolumes);
    unite(result.used);
    unite(result.wanted);
    if (!query.passable.empty()) replacePassed(query, result);
    return result;
}

std::vector<PageDemand> demand(const CutQuery& query) {
    CutQuery anywhere = query;
    anywhere.volumes = {};
    Cut result = cut(anywhere);
    append(result.used, result.wanted);
    return std::move(result.used);
}

std::vector<PageDemand> findPrefetchSet(
    const CutQuery& query, const Cut& cut, std::span<const hierarchy::PageInfo> pages) {
    // Pages are processed by ascending id, because only pages with higher ids refine a page. All coarser pages of a
    // page are therefore complete before the page.
    std::map<std::uint32_t, double> pixelsOf;
    for (const PageDemand& wanted : cut.wanted)
        pixelsOf[wanted.page] = wanted.pixels;
    std::vector<PageDemand> result;
    auto known = cut.wanted.begin(); // next wanted page; sorted by id like `pixelsOf`
    for (; !pixelsOf.empty(); pixelsOf.erase(pixelsOf.begin())) {
        const auto [page, pixels] = *pixelsOf.begin();
        if (known != cut.wanted.end() && known->page == page) {
            ++known;
        } else {
            result.push_back({page, pixels});
        }
        for (const std::uint32_t child : pages[page].children) {
            if (query.resident[child] != nullptr) continue;
            const hierarchy::PageInfo& info = pages[child];
            // The error in pixels of a refinement is never larger than that of the group that it refines.
            const double maxPixels = std::min(pixels, query.rule->pixels(info.bounds, info.maxError));
            if (maxPixels > query.errorPixels) pixelsOf[child] = std::max(pixelsOf[child], maxPixels);
        }
    }
    return result;
}

Cut cut(const CutQuery& query) {
    std::vector<std::uint32_t> missingRoots;
    CutPart part(query);
    for (const PageVisit& visit : visitedPages(query, missingRoots))
        part.add(visit);
    return CutPart::joined(query, {&part, 1}, missingRoots);
}

} // namespace gnomon::lod
