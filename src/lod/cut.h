// The LOD cut of a view: it selects the groups to refine, as far as their pages are resident. It also lists the missing
// pages that would add detail.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/residency.h"
#include "lod/error_rule.h"
#include "lod/traversal.h"

#include <span>
#include <vector>

namespace gnomon::lod {

/// A range of adjacent clusters of one page, which are all drawn.
struct ClusterRange {
    std::uint32_t page = 0;
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    auto operator<=>(const ClusterRange&) const = default;
};

/// The drawn clusters whose boxes intersect one volume.
struct DrawList {
    std::vector<ClusterRange> ranges; // each cluster at most once
    std::uint64_t clusters = 0;
    std::uint64_t triangles = 0;
    bool operator==(const DrawList&) const = default;
};

/// The draw lists of a cut.
struct DrawLists {
    DrawList image;
    std::vector<DrawList> casters;  // one per shadow pass, or a single list with the casters of rays or exact shadows
    std::vector<DrawList> sections; // one per section plane: the clusters near it
    bool operator==(const DrawLists&) const = default;

    /// Returns all draw lists in the order of the query's volumes.
    std::vector<const DrawList*> all() const;
};

/// The bounding volume trees over a model's pages, one tree per level. In a tree over mixed levels, the error test
/// would skip few nodes.
class PageTrees {
public:
    /// Builds the trees from the page table. This takes milliseconds for tens of thousands of pages.
    PageTrees(std::span<const hierarchy::PageInfo> pages, const hierarchy::Grid& grid);

    struct PageItem {
        std::uint32_t page = 0;
        Sphere bounds;
        double error = 0; // max error of its groups
        bool holdsRoot = false;
    };

    struct Level {
        lod::Tree tree;
        std::vector<PageItem> items; // in the order of the tree's item indices
    };

    /// Returns the trees of the levels, coarsest first.
    std::span<const Level> levels() const { return levels_; }

    const hierarchy::Grid& grid() const { return grid_; }

private:
    std::vector<Level> levels_;
    hierarchy::Grid grid_;
};

/// The input for computing a cut. The spans must outlive the call.
struct CutQuery {
    const PageTrees* trees = nullptr;
    hierarchy::ResidentPages resident;
    const ErrorRule* rule = nullptr;
    double errorPixels = 1; // groups whose error in pixels exceeds this limit are refined
    // Volumes in local space, fewer than lod::kMaxVolumes: first the volume of the image, then the volumes of the
    // casters, then the volumes of the sections.
    std::span<const ConvexVolume> volumes;
    const hierarchy::BlockedGroups* blocked = nullptr; // groups that must not be refined; null: none
    /// The page table, if the caller draws the cut only when it wants no pages. The cut then does not need the pages
    /// whose groups it certainly refines (`isSkippable`). Otherwise empty.
    std::span<const hierarchy::PageInfo> passable = {};
    std::size_t sectionVolumes = 0; // number of section volumes at the end of `volumes`
};

/// A cut: one draw list per volume, and the cost. If the resident pages are ancestor-complete, the cut draws exactly
/// one cluster along each chain of refinement that intersects a volume. `used` and `wanted` together are the pages with
/// a group whose error exceeds `errorPixels`, as far as the resident pages tell. They depend neither on volumes nor on
/// earlier frames, so each cut of the same view wants the same pages.
struct Cut {
    DrawLists lists;
    // resident pages into which the cut refines; each page once, sorted by id
    std::vector<hierarchy::PageDemand> used;
    // missing pages into which the cut would refine; each page once, sorted by id
    std::vector<hierarchy::PageDemand> wanted;
    // skippable pages that are not resident and whose groups the cut refines, sorted by id
    std::vector<std::uint32_t> passed;
    double errorPixels = 0;         // error limit of the cut, in pixels
    double achievedErrorPixels = 0; // max screen-space error of the image, in pixels
    std::uint64_t groupsTested = 0;
    // drawn clusters that the traversal tested against caster volumes, once per volume
    std::uint64_t clustersTested = 0;
};

/// A resident page that the traversal reached, and its relation to the query's volumes. A page without a volume is
/// visited only for the pages that refine it.
struct PageVisit {
    std::uint32_t page = 0;
    lod::VolumeMask mask;
    bool holdsRoot = false;
};

/// Returns the resident pages that may contain a group to refine. Adds the root pages that are not resident to
/// `missingRoots`.
std::vector<PageVisit> visitedPages(const CutQuery& query, std::vector<std::uint32_t>& missingRoots);

/// The part of a cut that some of the visited pages contribute. Threads can compute the parts of different pages in
/// parallel.
class CutPart {
public:
    explicit CutPart(const CutQuery& query);

    /// Adds the drawn clusters of one page.
    void add(const PageVisit& visit);

    /// Combines the parts, in this order, to one cut.
    static Cut joined(
        const CutQuery& query, std::span<const CutPart> parts, std::span<const std::uint32_t> missingRoots);

private:
    /// The result of the error rule for a refinement of the current page.
    struct RefinementState {
        double viewPixels = 0;
        bool isRefined = false;
    };

    /// A plane of a volume that intersects the current box.
    struct CutPlane {
        glm::dvec3 normal{0};
        double offset = 0;
        std::uint64_t volume = 0; // the bit of its volume
    };

    /// A range of adjacent drawn clusters that intersect the same volumes.
    struct Run {
        ClusterRange range;
        std::uint64_t touching = 0;
        std::uint64_t triangles = 0;
    };

    void addGroup(const hierarchy::Page& page, const hierarchy::Group& group, std::uint32_t id, std::uint64_t touching);
    std::uint64_t narrowed(
        std::uint64_t touching,
        std::span<const CutPlane> planes,
        const hierarchy::GridBox& box,
        std::vector<CutPlane>* still) const;
    bool isBlocked(std::uint32_t page, std::uint32_t group) const;
    bool isPassed(std::uint32_t page);
    void collectPlanes(lod::VolumeMask mask);
    double shownPixels(const hierarchy::Page& page, const hierarchy::Cluster& cluster) const;
    void test(const hierarchy::Page& page);
    void draw(std::uint32_t page, std::uint32_t cluster, std::uint32_t triangles, std::uint64_t touching);
    void flush();

    const CutQuery* query_;
    std::vector<DrawList> lists_;
    std::vector<hierarchy::PageDemand> used_;
    std::vector<hierarchy::PageDemand> wanted_;
    std::vector<RefinementState> refinements_;
    std::uint32_t asked_ = hierarchy::kNone; // the last page passed to isPassed
    bool isAskedSkippable_ = false;
    std::vector<CutPlane> pagePlanes_;
    std::vector<CutPlane> groupPlanes_;
    double step_; // step of the grid, in world units
    Run run_;
    double achieved_ = 0;
    std::uint64_t groupsTested_ = 0;
    std::uint64_t clustersTested_ = 0;
};

/// Returns the pages that a cut of `query` would use or want, without computing the cut. Prefetching needs this list.
/// The result does not depend on the volumes.
std::vector<hierarchy::PageDemand> demand(const CutQuery& query);

/// Returns the prefetch set of `cut`: the finer pages that the cut may want after its wanted pages are loaded. The page
/// table determines the set. The set contains all such pages, each once, sorted by id. It includes all levels, so that
/// pages need not be loaded level after level. If the cut wants no pages, the set is empty.
std::vector<hierarchy::PageDemand> findPrefetchSet(
    const CutQuery& query, const Cut& cut, std::span<const hierarchy::PageInfo> pages);

/// Returns true if `page` is skippable: the page table proves that a cut of `query` refines all groups of the page, and
/// thus draws none of its clusters. A page with root groups is never skippable.
bool isSkippable(const CutQuery& query, std::uint32_t page);

/// Replaces the skippable pages in `cut` by the pages that refine them. These become wanted pages, or used pages if
/// they are resident.
void replacePassed(const CutQuery& query, Cut& cut);

/// Returns the cut of `query`, computed on one thread. lod::cutFrame computes the same cut on all cores.
Cut cut(const CutQuery& query);

/// Returns the smallest error limit in pixels, not below the limit of the query, for which the clusters of the first
/// volume have at most `maxTriangles` triangles. If no limit achieves this, returns the limit above which only root
/// groups are refined. The cap on triangles thus increases the error of all clusters equally.
double cappedErrorPixels(const CutQuery& query, std::uint64_t maxTriangles);

} // namespace gnomon::lod
