// The resident pages of a model. A frame admits loaded pages and requests the pages of its cut.
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
    /// A page that cannot be read counts as damaged; on a server, it counts as missing and is requested again.
    /// Otherwise such a page is an error.
    bool drawsWithoutUnread = false;
    /// If true, `memory` is the limit of the whole process: tables, pages, the program, the images and the temporary
    /// memory of drawing. If false, it limits only tables and pages.
    bool holdsPictures = false;
};

/// Returns the approximate memory of the tables of `model`, with all structures that are built from them at run time.
Bytes tableBytes(const hierarchy::ModelFile& model);

/// The pages of one model. A frame calls `admitLoaded`, computes a cut with `query`, and calls `serve` with this cut. A
/// frame that waits repeats the cut and `serve` until nothing changes. The drawn pages then stay resident until the
/// next `admitLoaded`.
class Residency {
public:
    /// `model` must outlive this object. Throws Error if the root is damaged, if the tables alone exceed the memory, or
    /// if the model is too large or too small to be drawn.
    Residency(const hierarchy::ModelFile& model, ResidencyOptions options);

    /// Returns a query with the members that depend on the model. The caller sets the members that depend on the view.
    lod::CutQuery query() const;

    hierarchy::ResidentPages resident() const { return store_.resident(); }

    /// Returns true if `page` could not be read.
    bool isDamaged(std::uint32_t page) const { return store_.isDamaged(page); }

    /// Begins a frame. If frames never wait, makes the newly loaded pages resident. Frames that wait do not load the
    /// coarser ancestors of their pages, until the first frame that does not wait. `needsAllAbove` loads the ancestors
    /// in any case.
    void admitLoaded(Waiting waiting, bool needsAllAbove = false);

    /// Requests the pages that `cut` of `query` wants, and waits for them unless `waiting` is Never. The first volume
    /// must be the image's.
    lod::DemandOutcome serve(const lod::CutQuery& query, const lod::Cut& cut, Waiting waiting);

    /// Returns the pages that `cut` of `query` needs. The result is exact if `cut.wanted` is empty, and otherwise a
    /// superset.
    std::vector<std::uint32_t> pagesOf(const lod::CutQuery& query, const lod::Cut& cut) const;

    /// Returns the memory of the tables and `pages`.
    Bytes bytesWith(std::span<const std::uint32_t> pages) const;

    /// Returns the memory of ray trees over all of `pages`.
    Bytes rayTreeBytesWith(std::span<const std::uint32_t> pages) const;

    /// Returns the memory for tables, pages and, with `holdsPictures`, images.
    Bytes memory() const { return memory_; }

    /// Reserves `bytes` of the memory for other uses than pages. The pages of the last frame that waited stay resident.
    void reserve(Bytes bytes) {
        store_.reserve({bytes.count + picture_.count});
        reserved_ = bytes;
    }

    /// Reserves `bytes` for an image, in addition to `reserve`. With `holdsPictures`, a third of the remaining memory
    /// is also reserved for the temporary memory of drawing, and the largest reservation so far is preserved. Throws
    /// Error with the required memory if the image and the pinned pages do not fit together.
    void reservePicture(Bytes bytes);

    /// Returns true if `memory` includes the images.
    bool holdsPictures() const { return holdsPictures_; }

    /// Reserves memory for a ray tree per page, within the same memory limit, or deletes the trees and releases their
    /// memory. Throws Error if the trees and the pinned pages do not fit together.
    void keepRayTrees(bool areKept);

    /// Returns the ray trees of resident pages. Requires keepRayTrees(true). The tree of a page is deleted when the
    /// page is evicted.
    raytrace::KeptTrees& rayTrees() {
        GNOMON_CHECK(rayTrees_);
        return *rayTrees_;
    }

    /// Returns the current memory of the ray trees.
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
    bool isOpen_ = false;       // true: pages of this frame are loaded without their ancestors
    lod::FilePageSource source_;
    std::unique_ptr<raytrace::KeptTrees> rayTrees_; // null if no trees are kept
    lod::PageStore store_;
    lod::PageTrees trees_;
    std::optional<lod::DetailView> before_; // view of the previous frame
};

/// Returns `demands` with priorities that use the boxes of their pages (rows of `pages`). The most urgent pages are
/// then first in a limited budget. Pages out of view come last, unless shadows need them. Boxes are used because the
/// sphere of a group encloses the spheres of all finer groups. Inside a model, most spheres therefore contain the eye,
/// and all pages would seem urgent. A priority is never increased, and pages with a root group are unchanged.
std::vector<hierarchy::PageDemand> rankedByBoxes(
    const lod::CutQuery& query,
    std::span<const hierarchy::PageDemand> demands,
    std::span<const hierarchy::PageInfo> pages);

/// Returns the view that the motion from `before` to `now` reaches after `frames` more frames.
lod::DetailView continued(const lod::DetailView& before, const lod::DetailView& now, double frames);

} // namespace gnomon::frame
