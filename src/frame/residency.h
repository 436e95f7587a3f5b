// Manages the model pages in memory. Each frame first adds the pages that were loaded, and then requests the pages of
// its clusters.
#pragma once

#include "core/check.h"
#include "frame/frame_options.h"
#include "hierarchy/model_file.h"
#include "lod/cut.h"
#include "lod/page_store.h"
#include "raytrace/kept_trees.h"

#include <functional>
#include <memory>
#include <optional>

namespace gnomon::frame {

struct ResidencyOptions {
    Bytes memory = gibibytes(1); // for tables and decoded pages
    std::function<void(const lod::DamagedPage&)> onDamaged;
    /// True: a page that cannot be read counts as damaged, and drawing continues without it. A page on a server counts
    /// as missing and is requested again. False: such a page is an error.
    bool drawsWithoutUnread = false;
    /// True: `memory` limits the whole process: tables, pages, the program, the images and the temporary memory of
    /// drawing. False: it limits only tables and pages.
    bool holdsPictures = false;
};

/// Returns the approximate memory of the page table of `model`, including all run-time structures that are
/// built from them.
Bytes tableBytes(const hierarchy::ModelFile& model);

/// The pages of one model in memory. A frame calls `admitLoaded`, selects clusters (a cut) with `query`, and calls
/// `serve` with this cut. A frame that waits for pages repeats the selection and `serve` until nothing changes. The
/// drawn pages then stay in memory until the next `admitLoaded`.
class Residency {
public:
    /// Opens `model`, which must outlive this object. Throws Error if the root page is damaged, if the tables alone
    /// exceed the memory limit, or if the model is too large or too small to be drawn.
    Residency(const hierarchy::ModelFile& model, ResidencyOptions options);

    /// Returns a query for selecting clusters of this model. The caller sets the members that depend on the view.
    lod::CutQuery query() const;

    hierarchy::ResidentPages resident() const { return store_.resident(); }

    /// Returns true if `page` could not be read.
    bool isDamaged(std::uint32_t page) const { return store_.isDamaged(page); }

    /// Begins a frame. If `waiting` is Never, makes the newly loaded pages available for drawing. Frames that wait for
    /// pages do not load the coarser ancestors of their pages, until the first frame with Waiting::Never. If
    /// `needsAllAbove`, the ancestors are always loaded.
    void admitLoaded(Waiting waiting, bool needsAllAbove = false);

    /// Requests the pages that the clusters in `cut` need, and waits for them unless `waiting` is Never. `cut` must be
    /// the result of `query`, whose first volume must be the view pyramid of the image.
    lod::DemandOutcome serve(const lod::CutQuery& query, const lod::Cut& cut, Waiting waiting);

    /// Returns the pages that the clusters in `cut` need. `cut` must be the result of `query`. If `cut.wanted` is not
    /// empty, the result may contain more pages than necessary.
    std::vector<std::uint32_t> pagesOf(const lod::CutQuery& query, const lod::Cut& cut) const;

    /// Returns the memory of the tables plus the memory of the decoded `pages`.
    Bytes bytesWith(std::span<const std::uint32_t> pages) const;

    /// Returns the memory of the ray-tracing trees of all `pages`.
    Bytes rayTreeBytesWith(std::span<const std::uint32_t> pages) const;

    /// Returns the memory limit for tables and pages. With `holdsPictures`, the limit also includes images.
    Bytes memory() const { return memory_; }

    /// Reserves `bytes` of the memory limit for other data than pages. Pages may be evicted, except the pages of the
    /// last frame that waited for its pages.
    void reserve(Bytes bytes) {
        store_.reserve({bytes.count + picture_.count});
        reserved_ = bytes;
    }

    /// Reserves `bytes` of the memory limit for an image, in addition to `reserve`. With `holdsPictures`, a third of
    /// the remaining memory is also reserved for temporary data of drawing, and later calls never reduce the
    /// reservation. Throws Error with the required memory if the image and the never-evicted pages do not fit together.
    void reservePicture(Bytes bytes);

    /// Returns true if the memory limit includes the images.
    bool holdsPictures() const { return holdsPictures_; }

    /// Switches ray-tracing trees on or off. If `areKept`, reserves memory for one tree per page, within the memory
    /// limit. Otherwise deletes all trees and releases their memory. Throws Error if the trees and the never-evicted
    /// pages do not fit together.
    void keepRayTrees(bool areKept);

    /// Returns the ray-tracing trees of the pages in memory. Requires keepRayTrees(true). When a page is evicted, its
    /// tree is deleted.
    raytrace::KeptTrees& rayTrees() {
        GNOMON_CHECK(rayTrees_);
        return *rayTrees_;
    }

    /// Returns the memory that the ray-tracing trees use now.
    Bytes rayTreeBytes() const { return rayTrees_ ? rayTrees_->bytes() : Bytes(); }

    const lod::StoreStatistics& statistics() const { return store_.statistics(); }

private:
    std::vector<hierarchy::PageDemand> alongTheMotion(const lod::CutQuery& query);

    const hierarchy::ModelFile* model_;
    Bytes memory_;
    Bytes reserved_;
    Bytes picture_;
    bool holdsPictures_ = false;
    bool hasNotWaited_ = false; // true: a frame with Waiting::Never has begun
    bool isOpen_ = false;       // true: this frame loads pages without their ancestors
    lod::FilePageSource source_;
    std::unique_ptr<raytrace::KeptTrees> rayTrees_; // null without ray-tracing trees
    lod::PageStore store_;
    lod::PageTrees trees_;
    std::optional<lod::DetailView> before_; // view of the previous frame
};

/// Returns the page requests `demands` with new priorities, computed from the bounding boxes in `pages`. With a limited
/// budget, the most urgent pages are then loaded first. Pages out of view come last, unless shadows need them. The
/// previous priorities use the bounding sphere of a group, which encloses the spheres of all finer groups. Inside a
/// model, most spheres therefore contain the eye, and all pages would seem urgent. The function never increases a
/// priority, and does not change pages with a root group.
std::vector<hierarchy::PageDemand> rankedByBoxes(
    const lod::CutQuery& query,
    std::span<const hierarchy::PageDemand> demands,
    std::span<const hierarchy::PageInfo> pages);

/// Extrapolates the camera motion from `before` to `now` by `frames` more frames, and returns the view at its end.
lod::DetailView continued(const lod::DetailView& before, const lod::DetailView& now, double frames);

} // namespace gnomon::frame
