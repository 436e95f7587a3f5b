// The LOD cut of a view: one decision per group, limited to what is resident, and the pages that would sharpen it.
#pragma once

#include "bvh/traversal.h"
#include "hierarchy/model.h"
#include "hierarchy/residency.h"
#include "selection/error_rule.h"

#include <span>
#include <vector>

namespace gnomon::selection {

/// Clusters of one page, to be drawn; neighbours in the page.
struct ClusterRange {
    std::uint32_t page = 0;
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    auto operator<=>(const ClusterRange&) const = default;
};

/// The drawn clusters whose boxes touch one volume.
struct DrawList {
    std::vector<ClusterRange> ranges; // each cluster at most once
    std::uint64_t clusters = 0;
    std::uint64_t triangles = 0;
};

/// The trees over a model's pages, one per level, since mixing levels spoils the pruning by error.
class PageTrees {
public:
    /// Needs the page table alone; milliseconds for tens of thousands of pages.
    PageTrees(std::span<const hierarchy::PageInfo> pages, const hierarchy::Grid& grid);

    struct PageItem {
        std::uint32_t page = 0;
        Sphere bounds;
        double error = 0; // the largest of its groups
        bool holdsRoot = false;
    };

    struct Level {
        bvh::Tree tree;
        std::vector<PageItem> items; // as the tree names them
    };

    /// Coarsest first.
    std::span<const Level> levels() const { return levels_; }

    const hierarchy::Grid& grid() const { return grid_; }

private:
    std::vector<Level> levels_;
    hierarchy::Grid grid_;
};

/// What is to be cut. The spans must outlive the call.
struct CutQuery {
    const PageTrees* trees = nullptr;
    hierarchy::ResidentPages resident;
    const ErrorRule* rule = nullptr;
    double errorPixels = 1;                // refined where the rule gives more
    std::span<const ConvexVolume> volumes; // local space; fewer than bvh::kMaxVolumes; the first is the image's
    const hierarchy::BlockedGroups* blocked = nullptr; // groups that stay unrefined whatever the rule says, if any
    /// The page table, if the cut is drawn only once it wants nothing: then pages that it surely refines as a whole
    /// need not be there (`isPassedThrough`).
    std::span<const hierarchy::PageInfo> passable = {};
};

/// The result: one list per volume, and what it took. Along every chain of refinement that a volume reaches, exactly
/// one cluster is drawn, whatever is resident, as long as that is closed upwards. `used` and `wanted` together name the
/// pages that hold a group with more than `errorPixels`, as far as resident pages know of them: they depend neither on
/// boxes nor on the past, so a cut of the same view wants the same pages wherever it comes from.
struct Cut {
    std::vector<DrawList> lists;               // as the query's volumes
    std::vector<hierarchy::PageDemand> used;   // resident pages that the cut refines into, each once, by id
    std::vector<hierarchy::PageDemand> wanted; // pages that it would refine into were they resident, each once, by id
    std::vector<std::uint32_t> passed;         // pages that it refines through and that are not resident, by id
    double errorPixels = 0;                    // the threshold that it was made with
    double achievedErrorPixels = 0;            // the most on the screen of anything in the first list
    std::uint64_t groupsTested = 0;
    std::uint64_t clustersTested = 0; // drawn clusters that the walk came to, once for each volume but the first
};

/// A resident page that the walk reached, and how it lies to the query's volumes: it may touch none, and is visited for
/// the pages that refine it.
struct PageVisit {
    std::uint32_t page = 0;
    bvh::VolumeMask mask;
    bool holdsRoot = false;
};

/// The resident pages that may hold a refined group; root pages that are not resident go to `missingRoots`.
std::vector<PageVisit> visitedPages(const CutQuery& query, std::vector<std::uint32_t>& missingRoots);

/// The part of a cut that some of the visited pages make; parts of disjoint visits can be made on different threads.
class CutPart {
public:
    explicit CutPart(const CutQuery& query);

    /// Adds the drawn clusters of one page.
    void add(const PageVisit& visit);

    /// Appends the parts, in this order, into one cut.
    static Cut joined(
        const CutQuery& query, std::span<const CutPart> parts, std::span<const std::uint32_t> missingRoots);

private:
    /// What is known of a refinement of the current page.
    struct RefinementState {
        double viewPixels = 0;
        bool isRefined = false;
    };

    /// A plane of a volume that a box has parts on both sides of.
    struct CutPlane {
        glm::dvec3 normal{0};
        double offset = 0;
        std::uint64_t volume = 0; // its bit
    };

    /// Neighbouring drawn clusters that touch the same volumes.
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
    void collectPlanes(bvh::VolumeMask mask);
    double shownPixels(const hierarchy::Page& page, const hierarchy::Cluster& cluster) const;
    void test(const hierarchy::Page& page);
    void draw(std::uint32_t page, std::uint32_t cluster, std::uint32_t triangles, std::uint64_t touching);
    void flush();

    const CutQuery* query_;
    std::vector<DrawList> lists_;
    std::vector<hierarchy::PageDemand> used_;
    std::vector<hierarchy::PageDemand> wanted_;
    std::vector<RefinementState> refinements_;
    std::uint32_t asked_ = hierarchy::kNone; // whether this page is passed through was asked for last
    bool isAskedPassed_ = false;
    std::vector<CutPlane> pagePlanes_;
    std::vector<CutPlane> groupPlanes_;
    double step_; // of the grid
    Run run_;
    double achieved_ = 0;
    std::uint64_t groupsTested_ = 0;
    std::uint64_t clustersTested_ = 0;
};

/// The pages that a cut of `query` would use or want, without making it: for prefetching. Volumes do not matter.
std::vector<hierarchy::PageDemand> demand(const CutQuery& query);

/// The pages below those that `cut` (of `query`) wants that it may come to want once they are there, as far as their
/// rows in the page table tell; never fewer than it will, each once, by id. All levels at once, so loading need not
/// wait level by level. Where nothing is wanted nothing is foreseen: what is resident says all.
std::vector<hierarchy::PageDemand> foreseenPages(
    const CutQuery& query, const Cut& cut, std::span<const hierarchy::PageInfo> pages);

/// Whether a cut of `query` refines all that refines `page`, by the page table alone, so that it draws nothing of it,
/// whatever it holds; never so of pages with root groups.
bool isPassedThrough(const CutQuery& query, std::uint32_t page);

/// Has `cut` of `query` want, or use, in place of pages that it passes through those that refine them.
void replacePassed(const CutQuery& query, Cut& cut);

/// The cut, on one thread. culling::cutFrame does the same on all.
Cut cut(const CutQuery& query);

/// The least threshold, not below the query's, at which the clusters in the first volume have at most `maxTriangles`
/// triangles (as far as that is possible at all): so a cap raises the error evenly.
double cappedErrorPixels(const CutQuery& query, std::uint64_t maxTriangles);

} // namespace gnomon::selection
