// Selects the clusters of a view at the required level of detail (a cut), as far as their pages are in memory. Also
// lists the missing pages that would add detail.
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

/// The list of drawn clusters whose boxes intersect one volume, such as the view pyramid.
struct DrawList {
    std::vector<ClusterRange> ranges; // each cluster at most once
    std::uint64_t clusters = 0;
    std::uint64_t triangles = 0;
    bool operator==(const DrawList&) const = default;
};

/// The lists of drawn clusters of a cut: for the image, the casters and the sections.
struct DrawLists {
    DrawList image;
    // one list per shadow map, or a single list with the casters of rays or exact shadows
    std::vector<DrawList> casters;
    std::vector<DrawList> sections; // one list per section plane: the clusters near the plane
    bool operator==(const DrawLists&) const = default;

    /// Returns all lists of drawn clusters, in the order of the query's volumes.
    std::vector<const DrawList*> all() const;
};

/// The bounding volume trees over a model's pages, one tree per level of detail. In a tree over mixed levels, the error
/// test would skip few nodes.
class PageTrees {
public:
    /// Builds the bounding volume trees from the page table. This takes milliseconds for tens of thousands of pages.
    PageTrees(std::span<const hierarchy::PageInfo> pages, const hierarchy::Grid& grid);

    struct PageItem {
        std::uint32_t page = 0;
        Sphere bounds;
        double error = 0; // max stored error of the groups in the page
        bool holdsRoot = false;
    };

    struct Level {
        lod::Tree tree;
        std::vector<PageItem> items; // in the order of the tree's item indices
    };

    /// Returns the bounding volume trees, one per level of detail, coarsest first.
    std::span<const Level> levels() const { return levels_; }

    const hierarchy::Grid& grid() const { return grid_; }

private:
    std::vector<Level> levels_;
    hierarchy::Grid grid_;
};

/// The input for selecting the clusters of a view (a cut). The spans must outlive the call.
struct CutQuery {
    const PageTrees* trees = nullptr;
    hierarchy::ResidentPages resident;
    const ErrorRule* rule = nullptr;
    double errorPixels = 1; // groups of clusters whose error in pixels exceeds this limit are refined
    // Convex volumes in local space, fewer than lod::kMaxVolumes: first the view pyramid of the image, then the volumes
    // of the casters, then the volumes of the section planes.
    std::span<const ConvexVolume> volumes;
    const hierarchy::BlockedGroups* blocked = nullptr; // groups that must not be refined; null: none
    /// The page table, or empty. Set it only if the caller draws the cut only when no pages are missing. Pages whose
    /// groups the cut certainly refines (`isSkippable`) then need not be in memory.
    std::span<const hierarchy::PageInfo> passable = {};
    std::size_t sectionVolumes = 0; // number of section planes' volumes at the end of `volumes`
};

/// The selected clusters of a view: one list of drawn clusters per volume, and the cost of the selection. If all
/// coarser pages above each page in memory are also in memory, exactly one cluster is drawn along each chain of
/// refinement that intersects a volume. `used` and `wanted` together are the pages with a group whose error exceeds
/// `errorPixels`, as far as the pages in memory tell. They depend neither on volumes nor on earlier frames, so each cut
/// of the same view wants the same pages.
struct Cut {
    DrawLists lists;
    // pages in memory whose finer clusters replace coarser clusters in the cut; each page once, sorted by id
    std::vector<hierarchy::PageDemand> used;
    // missing pages whose finer clusters would replace coarser clusters in the cut; each page once, sorted by id
    std::vector<hierarchy::PageDemand> wanted;
    // missing pages that are not needed, because the cut certainly refines all their groups (`isSkippable`); sorted by
    // id
    std::vector<std::uint32_t> passed;
    double errorPixels = 0;         // error limit of the selected clusters, in pixels
    double achievedErrorPixels = 0; // max screen-space error of the drawn image, in pixels
    std::uint64_t groupsTested = 0;
    // drawn clusters that the traversal tested against caster volumes, once per volume
    std::uint64_t clustersTested = 0;
};

/// A page in memory that the traversal of the bounding volume trees reached, and the volumes that its box intersects. A
/// page whose box intersects no volume is visited only because of the finer pages that refine it.
struct PageVisit {
    std::uint32_t page = 0;
    lod::VolumeMask mask;
    bool holdsRoot = false;
};

/// Returns the pages in memory that may contain a group of clusters to refine. Adds the root pages that are not in
/// memory to `missingRoots`.
std::vector<PageVisit> visitedPages(const CutQuery& query, std::vector<std::uint32_t>& missingRoots);

/// The clusters of a cut that belong to some of the visited pages. Threads can compute the parts of different pages in
/// parallel.
class CutPart {
public:
    explicit CutPart(const CutQuery& query);

    /// Adds the drawn clusters of the visited page to this part of the cut.
    void add(const PageVisit& visit);

    /// Combines the parts `parts`, in this order, to one cut.
    static Cut joined(
        const CutQuery& query, std::span<const CutPart> parts, std::span<const std::uint32_t> missingRoots);

private:
    /// Whether one refinement of the current page is needed, and its error in pixels.
    struct RefinementState {
        double viewPixels = 0;
        bool isRefined = false;
    };

    /// A plane of a convex volume that intersects the current box.
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
/// The volumes of `query` have no influence on the list.
std::vector<hierarchy::PageDemand> demand(const CutQuery& query);

/// Returns the finer pages that `cut` may want after its wanted pages are loaded, so that they can be prefetched. The
/// result contains each page once, sorted by id. It includes all levels of detail, so that pages need not be loaded
/// level after level. The page table determines the result. If the cut wants no pages, the result is empty.
std::vector<hierarchy::PageDemand> findPrefetchSet(
    const CutQuery& query, const Cut& cut, std::span<const hierarchy::PageInfo> pages);

/// Returns true if the page table proves that a cut of `query` refines all groups of `page`, and thus draws none of its
/// clusters. The page then need not be in memory. The result is false for a page with root groups.
bool isSkippable(const CutQuery& query, std::uint32_t page);

/// Replaces the unneeded pages in `cut.passed` by the pages that refine them. The refining pages become wanted pages,
/// or used pages if they are in memory.
void replacePassed(const CutQuery& query, Cut& cut);

/// Selects the clusters for `query` on one thread. lod::cutFrame computes the same result on all cores.
Cut cut(const CutQuery& query);

/// Returns the smallest error limit in pixels, not below the limit of the query, for which the clusters of the image
/// have at most `maxTriangles` triangles. If no limit achieves this, returns the limit above which only root groups are
/// refined. The cap on triangles thus increases the error of all clusters equally.
double cappedErrorPixels(const CutQuery& query, std::uint64_t maxTriangles);

} // namespace gnomon::lod
