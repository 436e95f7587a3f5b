#include "frame/residency.h"

#include "core/error.h"
#include "core/limit_error.h"
#include "hierarchy/validation.h"
#include "lod/frame_cut.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::frame {

namespace {

constexpr Milliseconds kUnreadPause{2000}; // pause before a page that a server failed to deliver is requested again

/// Number of frames for which prefetching extrapolates the camera motion: a third of a second at 30 frames per second.
/// The loading of a page with all its ancestors takes less time.
constexpr double kFramesAhead = 10;

constexpr Bytes kProgram = mebibytes(64); // memory of the process before it opens a model

/// Returns the memory limit for tables, pages and images, without the memory of the program itself. Throws Error if the
/// model cannot be drawn, or if the memory is too small for the tables of the model.
Bytes memoryWithoutProgram(const hierarchy::ModelFile& model, const ResidencyOptions& options) {
    if (const auto fault = hierarchy::drawingFault(model.pages(), model.summary().grid))
        throw Error(model.path(), *fault);
    const Bytes program = options.holdsPictures ? kProgram : Bytes();
    const Bytes required{program.count + tableBytes(model).count};
    if (options.memory <= required)
        throw LimitError(
            Limit::PageMemory,
            {"page memory",
             options.holdsPictures ? "too small: the program and the page table alone need more"
                                   : "too small: the page table alone needs more",
             "above " + readableBytes(required),
             readableBytes(options.memory)});
    return {options.memory.count - program.count};
}

bool hasMoved(const lod::DetailView& a, const lod::DetailView& b) {
    return a.eye != b.eye || a.basis.view != b.basis.view || a.basis.up != b.basis.up;
}

} // namespace

Bytes tableBytes(const hierarchy::ModelFile& model) {
    // The memory of a page's data in tables consists of its row in the page table, links to children and parents, the
    // entry in the page store, and the item and node in the tree.
    constexpr std::uint64_t kBytesPerPage = sizeof(hierarchy::PageInfo) + 320;
    constexpr std::uint64_t kBytesPerLink = 8;
    std::uint64_t links = 0;
    for (const hierarchy::PageInfo& page : model.pages())
        links += page.children.size();
    return {model.pages().size() * kBytesPerPage + links * kBytesPerLink};
}

Residency::Residency(const hierarchy::ModelFile& model, ResidencyOptions options)
    : model_(&model),
      memory_(memoryWithoutProgram(model, options)),
      holdsPictures_(options.holdsPictures),
      source_(model),
      store_(
          source_,
          {.budget = {memory_.count - tableBytes(model).count},
           .loaderThreads = model.source().parallelReads(),
           .onDamaged = std::move(options.onDamaged),
           .onEvicted =
               [this](std::uint32_t page) {
                   if (rayTrees_) rayTrees_->drop(page);
               },
           .drawsWithoutUnread = options.drawsWithoutUnread,
           .unreadPause = model.source().isRemote() ? std::optional(kUnreadPause) : std::nullopt}),
      trees_(model.pages(), model.summary().grid) {}

lod::CutQuery Residency::query() const {
    lod::CutQuery query;
    query.trees = &trees_;
    query.resident = store_.resident();
    query.blocked = &store_.blocked();
    if (isOpen_) query.passable = model_->pages();
    return query;
}

void Residency::reservePicture(Bytes bytes) {
    const std::uint64_t tables = tableBytes(*model_).count;
    const std::uint64_t left = memory_.count - std::min(memory_.count, tables + bytes.count);
    const std::uint64_t working = holdsPictures_ ? left / 3 : 0;
    const Bytes required{tables + bytes.count + store_.pinned().count + store_.pinned().count / 2};
    if (holdsPictures_ && required > memory_)
        throw LimitError(
            Limit::PageMemory,
            {"page memory",
             "too small for a picture of this size",
             "at least " + readableBytes({required.count + kProgram.count}),
             readableBytes({memory_.count + kProgram.count})});
    const Bytes reserved{bytes.count + working};
    // A smaller image does not reduce the memory reservation. Otherwise pages would fill the memory, and the next large
    // image would have to evict them.
    if (reserved == picture_ || (holdsPictures_ && reserved < picture_)) return;
    store_.reserve({reserved.count + reserved_.count});
    picture_ = reserved;
}

void Residency::keepRayTrees(bool areKept) {
    if (areKept == (rayTrees_ != nullptr)) return;
    rayTrees_ = areKept ? std::make_unique<raytrace::KeptTrees>() : nullptr;
    store_.reserveAuxiliary(areKept ? raytrace::keptTreeBytes : std::function<Bytes(const hierarchy::PageInfo&)>());
}

void Residency::admitLoaded(Waiting waiting, bool needsAllAbove) {
    // Frames that do not wait for pages draw coarser ancestors until finer pages are loaded. From the first such frame
    // on, the ancestors are therefore needed.
    hasNotWaited_ = hasNotWaited_ || waiting == Waiting::Never;
    isOpen_ = !hasNotWaited_ && !needsAllAbove;
    if (waiting == Waiting::Never) store_.admitLoaded();
}

lod::DemandOutcome Residency::serve(const lod::CutQuery& query, const lod::Cut& cut, Waiting waiting) {
    // A frame that waits for its pages loads one level of detail after the other, without prefetching. Such a frame is
    // complete as early as with prefetching, even over a network, and reads a sixth fewer bytes.
    if (waiting == Waiting::UntilComplete) {
        lod::DemandOutcome outcome = store_.load({.used = cut.used, .wanted = cut.wanted, .isOpen = isOpen_});
        // If the page store loads the coarser ancestors of all pages in one round of a frame, the following rounds must
        // do the same. Otherwise the frame could alternate between both modes without end.
        if (std::exchange(isOpen_, store_.isOpen()) != isOpen_) outcome.hasChanged = true;
        return outcome;
    }
    const std::vector<hierarchy::PageDemand> prefetchSet = lod::findPrefetchSet(query, cut, model_->pages());
    const auto ranked = [&](std::span<const hierarchy::PageDemand> demands) {
        return rankedByBoxes(query, demands, model_->pages());
    };
    return store_.request({ranked(cut.used), ranked(cut.wanted), ranked(prefetchSet), alongTheMotion(query)});
}

std::vector<std::uint32_t> Residency::pagesOf(const lod::CutQuery& query, const lod::Cut& cut) const {
    std::vector<std::uint32_t> pages = cut.passed;
    const std::vector<hierarchy::PageDemand> prefetchSet = lod::findPrefetchSet(query, cut, model_->pages());
    for (const std::span<const hierarchy::PageDemand> demands :
         {std::span(cut.used), std::span(cut.wanted), std::span(prefetchSet)})
        for (const hierarchy::PageDemand& demand : demands)
            pages.push_back(demand.page);
    return pages;
}

Bytes Residency::bytesWith(std::span<const std::uint32_t> pages) const {
    Bytes result = tableBytes(*model_);
    for (const std::uint32_t page : pages)
        result.count += lod::decodedBytes(model_->pages()[page]).count;
    return result;
}

Bytes Residency::rayTreeBytesWith(std::span<const std::uint32_t> pages) const {
    Bytes result;
    for (const std::uint32_t page : pages)
        result.count += raytrace::keptTreeBytes(model_->pages()[page]).count;
    return result;
}

std::vector<hierarchy::PageDemand> Residency::alongTheMotion(const lod::CutQuery& query) {
    const lod::DetailView& now = query.rule->view();
    const std::optional<lod::DetailView> before = std::exchange(before_, now);
    if (!before || !hasMoved(*before, now)) return {};
    const lod::ErrorRule rule(continued(*before, now, kFramesAhead));
    lod::CutQuery ahead = query;
    ahead.rule = &rule;
    ahead.volumes = {};
    lod::Cut cut = lod::cutFrame(ahead);
    const std::vector<hierarchy::PageDemand> prefetchSet = lod::findPrefetchSet(ahead, cut, model_->pages());
    std::vector<hierarchy::PageDemand> result = std::move(cut.used);
    result.insert(result.end(), cut.wanted.begin(), cut.wanted.end());
    result.insert(result.end(), prefetchSet.begin(), prefetchSet.end());
    return result;
}

std::vector<hierarchy::PageDemand> rankedByBoxes(
    const lod::CutQuery& query,
    std::span<const hierarchy::PageDemand> demands,
    std::span<const hierarchy::PageInfo> pages) {
    // priority of pages out of view: lower than all pages in view, but higher than prefetched pages
    constexpr double kOutOfView = 1e-15;
    std::vector<hierarchy::PageDemand> result(demands.begin(), demands.end());
    for (hierarchy::PageDemand& demand : result) {
        const hierarchy::PageInfo& info = pages[demand.page];
        if (std::isinf(demand.pixels) || std::isinf(info.maxError)) continue;
        const double seen = query.rule->maxViewPixels(query.trees->grid().local(info.box), info.maxError);
        const double shown = std::max(seen, query.rule->casterPixels(info.bounds, info.maxError));
        demand.pixels = shown > 0 ? std::min(demand.pixels, shown) : demand.pixels * kOutOfView;
    }
    return result;
}

lod::DetailView continued(const lod::DetailView& before, const lod::DetailView& now, double frames) {
    Camera camera;
    camera.eye = now.eye + frames * (now.eye - before.eye);
    const glm::dvec3 view = now.basis.view + frames * (now.basis.view - before.basis.view);
    const glm::dvec3 up = now.basis.up + frames * (now.basis.up - before.basis.up);
    // If the camera jumps or spins, the extrapolated view direction is useless.
    const bool isSteady = glm::dot(view, now.basis.view) > 0.5 && glm::dot(up, now.basis.up) > 0.5;
    camera.target = camera.eye + (isSteady ? view : now.basis.view);
    camera.up = isSteady ? up : now.basis.up;
    lod::DetailView result = now;
    result.eye = camera.eye;
    result.basis = cameraBasis(camera);
    return result;
}

} // namespace gnomon::frame
