// The LOD cut of a view: one decision per group, limited to resident pages, and the pages that would increase the
// detail.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/residency.h"
#include "lod/error_rule.h"
#include "lod/traversal.h"

#include <span>
#include <vector>

namespace gnomon::lod {

/// Adjacent clusters of one page that are drawn.
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

    /// Returns all lists in the order of the query's volumes.
    std::vector<const DrawList*> all() const;
};

/// The trees over a model's pages, one per level. A tree with mixed levels would prune badly by error.
class PageTrees {
public:
    /// Builds the trees from the page table. This takes milliseconds for tens of thousands of pages.
    PageTrees(std::span<const hierarchy::PageInfo> pages, const hierarchy::Grid& grid);

    struct PageItem {
        std::uint32_t page = 0;
        Sphere bounds;
        double error = 0; // max over its groups
        bool holdsRoot = false;
    };

    struct Level {
        lod::Tree tree;
        std::vector<PageItem> items; // in the order of the tree's item indices
    };

    /// Returns the levels, coarsest first.
    std::span<const Level> levels() const { return levels_; }

    const hierarchy::Grid& grid() const { return grid_; }

private:
    std::vector<Level> levels_;
    hierarchy::Grid grid_;
};

/// The input of a cut. The spans must outlive the call.
struct CutQuery {
    const PageTrees* trees = nullptr;
    hierarchy::ResidentPages resident;
    const ErrorRule* rule = nullptr;
    double errorPixels = 1; // refined where the rule gives more
    // In local space, fewer than lod::kMaxVolumes: the volume of the image, then of the casters, then of the sections.
    std::span<const ConvexVolume> volumes;
    const hierarchy::BlockedGroups* blocked = nullptr; // groups that stay unrefined whatever the rule says, if any
    /// The page table, if the cut is drawn only once it wants nothing: then pages that it surely refines as a whole
    /// need not be there (`isSkippable`).
    std::span<const hierarchy::PageInfo> passable = {};
    std::size_t sectionVolumes = 0; // number of volumes of the sections
};

/// A cut: one draw list per volume, and the cost. It draws exactly one cluster along each chain of refinement that
/// intersects a volume. This holds for each set of resident pages that is ancestor-complete. `used` and `wanted`
/// together are the pages that contain a group with more than `errorPixels`, as far as the resident pages tell. They
/// depend neither on boxes nor on earlier frames, so each cut of the same view wants the same pages.
struct Cut {
    DrawLists lists;
    std::vector<hierarchy::PageDemand> used;   // resident pages that the cut refines into, each once, by id
    std::vector<hierarchy::PageDemand> wanted; // missing pages that the cut would refine into, each once, by id
    std::vector<std::uint32_t> passed;         // pages that are not resident and that the cut refines through, by id
    double errorPixels = 0;                    // the threshold of the cut
    double achievedErrorPixels = 0;            // max screen-space error of the image
    std::uint64_t groupsTested = 0;
    std::uint64_t clustersTested = 0; // drawn clusters that the traversal reached, once per volume except the first
};

/// A resident page that the traversal reached, and its relation to the query's volumes. The page may intersect no
/// volume; it is then visited for the pages that refine it.
struct PageVisit {
    std::uint32_t page = 0;
    lod::VolumeMask mask;
    bool holdsRoot = false;
};

/// Returns the resident pages that may contain a refined group. Root pages that are not resident are added to
/// `missingRoots`.
std::vector<PageVisit> visitedPages(const CutQuery& query, std::vector<std::uint32_t>& missingRoots);

/// The part of a cut from some of the visited pages. Different threads can compute parts of disjoint pages.
class CutPart {
public:
    explicit CutPart(const CutQuery& query);

    /// Adds the drawn clusters of one page.
    void add(const PageVisit& visit);

    /// Joins the parts, in this order, into one cut.
    static Cut joined(
        const CutQuery& query, std::span<const CutPart> parts, std::span<const std::uint32_t> missingRoots);

private:
    /// The result for a refinement of the current page.
    struct RefinementState {
        double viewPixels = 0;
        bool isRefined = false;
    };

    /// A plane of a volume that intersects a box.
    struct CutPlane {
        glm::dvec3 normal{0};
        double offset = 0;
        std::uint64_t volume = 0; // the bit of its volume
    };

    /// Adjacent drawn clusters that intersect the same volumes.
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
    double step_; // of the grid
    Run run_;
    double achieved_ = 0;
    std::uint64_t groupsTested_ = 0;
    std::uint64_t clustersTested_ = 0;
};

/// Returns the pages that a cut of `query` would use or want, without the cut itself. This serves prefetching. The
/// result does not depend on the volumes.
std::vector<hierarchy::PageDemand> demand(const CutQuery& query);

/// Returns the prefetch set: the finer pages that `cut` may want after its wanted pages are loaded, according to the
/// page table. The set is never too small and contains each page once, by id. It covers all levels at once, so loading
/// does not wait for one level after another. The set is empty if the cut wants no pages.
std::vector<hierarchy::PageDemand> findPrefetchSet(
    const CutQuery& query, const Cut& cut, std::span<const hierarchy::PageInfo> pages);

/// Returns true if `page` is skippable: the page table proves that a cut of `query` refines all groups of the page and
/// thus draws none of its clusters. A page with root groups is never skippable.
bool isSkippable(const CutQuery& query, std::uint32_t page);

/// Replaces the skippable pages in `cut` by the pages that refine them, as wanted or used pages.
void replacePassed(const CutQuery& query, Cut& cut);

/// Returns the cut, computed on one thread. lod::cutFrame computes the same cut on all cores.
Cut cut(const CutQuery& query);

/// Returns the smallest threshold, not below the query's threshold, at which the clusters of the first volume have at
/// most `maxTriangles` triangles, if this is possible. The cap thus increases the error evenly.
double cappedErrorPixels(const CutQuery& query, std::uint64_t maxTriangles);

} // namespace gnomon::lod
