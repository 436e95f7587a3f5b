// What of a model is in memory, and what a frame does about it: admits the pages that were loaded and requests those
// that its cut wants.
#pragma once

#include "core/check.h"
#include "frame/frame_options.h"
#include "hierarchy/model_file.h"
#include "raycast/kept_trees.h"
#include "selection/cut.h"
#include "streaming/page_store.h"

#include <functional>
#include <memory>
#include <optional>

namespace gnomon::frame {

struct ResidencyOptions {
    Bytes memory = gibibytes(1); // tables and decoded pages
    std::function<void(const streaming::DamagedPage&)> onDamaged;
    /// A page that cannot be read counts as damaged, or on a server as missing, and is asked for again; else that is an
    /// error.
    bool drawsWithoutUnread = false;
    /// Whether `memory` is that of the process: the program itself, the images and what drawing takes beside them
    /// count, and not tables and pages alone.
    bool holdsPictures = false;
};

/// What the tables of `model` and all that is made of them at run time take, about.
Bytes tableBytes(const hierarchy::ModelFile& model);

/// The pages of one model. A frame calls `admitLoaded`, makes its cut of `query`, and calls `serve` with it until
/// nothing changes, once if it never waits; then what it draws stays until the next `admitLoaded`.
class Residency {
public:
    /// `model` must outlive it. Throws Error if the root is damaged, the tables alone take more than the memory,
    /// or the model is too large or too small to be drawn.
    Residency(const hierarchy::ModelFile& model, ResidencyOptions options);

    /// What of a cut's query is the model's and not the view's.
    selection::CutQuery query() const;

    hierarchy::ResidentPages resident() const { return store_.resident(); }

    /// Whether reading `page` has failed.
    bool isDamaged(std::uint32_t page) const { return store_.isDamaged(page); }

    /// Begins a frame: makes the pages that were loaded since the last one resident, if frames never wait. One that
    /// waits reads no page for being above others, until one has not waited; `needsAllAbove` if it does all the same.
    void admitLoaded(Waiting waiting, bool needsAllAbove = false);

    /// Requests what `cut` of `query` wants, and waits for it if frames do. The first volume is the image's.
    streaming::DemandOutcome serve(const selection::CutQuery& query, const selection::Cut& cut, Waiting waiting);

    /// The pages that `cut` of `query` takes: if it wants none just those, else no fewer.
    std::vector<std::uint32_t> pagesOf(const selection::CutQuery& query, const selection::Cut& cut) const;

    /// What the tables and `pages` take.
    Bytes bytesWith(std::span<const std::uint32_t> pages) const;

    /// What trees of rays over all of `pages` would take.
    Bytes rayTreeBytesWith(std::span<const std::uint32_t> pages) const;

    /// What tables, pages and, if it holds them, pictures may take.
    Bytes memory() const { return memory_; }

    /// Keeps `bytes` of the memory for something else than pages; what the last frame that waited needs stays resident.
    void reserve(Bytes bytes) {
        store_.reserve({bytes.count + picture_.count});
        reserved_ = bytes;
    }

    /// Likewise for a picture, besides. If `memory` holds the images, a third of what is left is for what drawing makes
    /// of the pages. Throws Error, with the memory that the picture needs, if it does not fit beside the pages that
    /// always stay. If `memory` holds the images, the room of the largest picture so far stays reserved.
    void reservePicture(Bytes bytes);

    /// Whether `memory` holds the images too.
    bool holdsPictures() const { return holdsPictures_; }

    /// Keeps room for trees of rays beside each page, in the same memory, or forgets the trees and gives that back.
    /// Throws Error if they do not fit beside the pages that always stay.
    void keepRayTrees(bool areKept);

    /// The trees of resident pages; only while they are kept. Those of a page go with it.
    raycast::KeptTrees& rayTrees() {
        GNOMON_CHECK(rayTrees_);
        return *rayTrees_;
    }

    /// What the trees take by now.
    Bytes rayTreeBytes() const { return rayTrees_ ? rayTrees_->bytes() : Bytes(); }

    const streaming::StoreStatistics& statistics() const { return store_.statistics(); }

private:
    std::vector<hierarchy::PageDemand> alongTheMotion(const selection::CutQuery& query);

    const hierarchy::ModelFile* model_;
    Bytes memory_;
    Bytes reserved_;
    Bytes picture_;
    bool holdsPictures_ = false;
    bool hasNotWaited_ = false; // a frame
    bool isOpen_ = false;       // this frame: pages come without those above them
    streaming::FilePageSource source_;
    std::unique_ptr<raycast::KeptTrees> rayTrees_; // null while none are kept
    streaming::PageStore store_;
    selection::PageTrees trees_;
    std::optional<selection::DetailView> before_; // the view of the frame before
};

/// `demands` by what the boxes of their pages, rows of `pages`, show of them, of which the most urgent have to come
/// first where not all fit: those out of view last, but for what shadows need. The sphere of a group encloses those of
/// all that refines it, so that inside of a model most reach to the eye, and all seem urgent. Never raised; whatever
/// holds a root group stays as it is.
std::vector<hierarchy::PageDemand> rankedByBoxes(
    const selection::CutQuery& query,
    std::span<const hierarchy::PageDemand> demands,
    std::span<const hierarchy::PageInfo> pages);

/// The view that the motion from `before` to `now` leads to in `frames` frames.
selection::DetailView continued(const selection::DetailView& before, const selection::DetailView& now, double frames);

} // namespace gnomon::frame
