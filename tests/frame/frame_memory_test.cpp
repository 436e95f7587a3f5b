// What a renderer allocates while a camera turns where it has turned before. Every large allocation of this program is
// counted.
#include "core/error.h"
#include "frame/accumulation.h"
#include "frame/renderer.h"
#include "render/software_backend.h"
#include "tests/support/made_model.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string>

#include <malloc.h>

namespace {

constexpr std::size_t kLarge = std::size_t{64} << 10U;

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): allocations of the whole program
std::atomic<std::size_t> largeAllocations{0};
std::atomic<std::size_t> largestBytes{0};
std::atomic<std::size_t> liveBytes{0}; // of all allocations, as large as they were made
std::atomic<std::size_t> maxBytes{0};  // that these were

// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void* counted(void* memory, std::size_t size) {
    if (memory == nullptr) throw std::bad_alloc();
    const std::size_t live = liveBytes += malloc_usable_size(memory);
    std::size_t max = maxBytes;
    while (live > max && !maxBytes.compare_exchange_weak(max, live)) {
    }
    if (size <= kLarge) return memory;
    ++largeAllocations;
    std::size_t largest = largestBytes;
    while (size > largest && !largestBytes.compare_exchange_weak(largest, size)) {
    }
    return memory;
}

/// Kept apart: inlined, it would seem to free what another operator made.
[[gnu::noinline]] void release(void* memory) {
    liveBytes -= malloc_usable_size(memory);
    std::free(memory);
}

} // namespace

void* operator new(std::size_t size) {
    return counted(std::malloc(size), size);
}

void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit), size);
}

void operator delete(void* memory) noexcept {
    release(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}

namespace gnomon::frame {
namespace {

constexpr int kFrames = 60;

/// Draws a turn around what `renderer` shows; how many large allocations that took.
std::size_t turn(Renderer& renderer, const plan::Quality& quality, int side) {
    const Box& bounds = renderer.model().summary().bounds;
    const double radius = 0.6 * glm::length(bounds.extent());
    plan::View view;
    view.width = view.height = side;
    view.camera.target = bounds.center();
    History history;
    const std::size_t before = largeAllocations;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double angle = 2 * 3.14159265358979 * frame / kFrames;
        view.camera.eye = bounds.center() + radius * glm::dvec3(std::sin(angle), 0.3, std::cos(angle));
        history = renderer.render(view, quality, {}, history).history;
    }
    return largeAllocations - before;
}

/// Two turns of each kind of shadows; nothing large may be allocated in the second. To be run on one thread: what each
/// thread keeps grows whenever chance gives it more work than before.
void expectNoneInTheSecondTurn(const hierarchy::ModelFile& model, int side) {
    const auto backend = render::makeSoftwareBackend();

    struct Row {
        const char* what;
        plan::ShadowMode shadows;
        plan::CasterCulling culling;
    };

    for (const Row& row :
         {Row{"off", plan::ShadowMode::Off, plan::CasterCulling::Auto},
          Row{"maps by receivers", plan::ShadowMode::Maps, plan::CasterCulling::Receivers},
          Row{"maps", plan::ShadowMode::Maps, plan::CasterCulling::On},
          Row{"exact", plan::ShadowMode::Exact, plan::CasterCulling::Auto}}) {
        SCOPED_TRACE(row.what);
        Renderer renderer(model, *backend, {});
        plan::Quality quality;
        quality.shadows = row.shadows;
        quality.cullCasters = row.culling;
        turn(renderer, quality, side);
        largestBytes = 0;
        EXPECT_EQ(turn(renderer, quality, side), 0U) << "the largest has " << largestBytes << " bytes";
    }
}

TEST(FrameMemory, TheHookCounts) {
    const std::size_t before = largeAllocations;
    EXPECT_EQ(std::string(kLarge + 1, 'x').size(), kLarge + 1);
    EXPECT_EQ(std::string(kLarge / 2, 'x').size(), kLarge / 2);
    EXPECT_EQ(largeAllocations, before + 1);
}

TEST(FrameMemory, ASecondTurnAllocatesNothingLarge) {
    const tests::BuiltFile model("plant", 20000);
    tbb::task_arena(1).execute([&] { expectNoneInTheSecondTurn(model.file(), 200); });
}

/// Draws all frames of a picture after one of one frame; how many bytes more that held.
std::size_t bytesOfSeveralFrames(Renderer& renderer, const plan::View& view, const plan::Quality& quality) {
    FrameOptions options;
    const History history = renderer.render(view, quality, options).history;
    const std::size_t before = liveBytes;
    maxBytes = before;
    options.isAccumulated = true;
    const Frame frame = renderer.render(view, quality, options, history);
    Accumulation accumulation;
    accumulation.begin(renderer, frame, 3);
    while (accumulation.samples() < accumulation.wanted())
        accumulation.add();
    EXPECT_EQ(accumulation.picture().width, view.width);
    return maxBytes - before;
}

ResidencyOptions within(Bytes memory) {
    ResidencyOptions options;
    options.memory = memory;
    return options;
}

// What --memory counts of a picture of several frames is what it takes, and pages leave that room.
TEST(FrameMemory, OfSeveralFramesIsCounted) {
    const tests::BuiltFile model("statue", 20000);
    plan::View view;
    view.width = 1024;
    view.height = 512;
    view.camera.target = model.file().summary().bounds.center();
    view.camera.eye = view.camera.target + 1.2 * model.file().summary().bounds.extent();
    for (const bool hasSky : {false, true}) {
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Exact;
        quality.look.shading = plan::Shading::Lit;
        if (hasSky) quality.sky.directions = 3;
        const Bytes counted = render::LightSum::bytes(std::uint64_t{1024} * 512, false, hasSky);
        const auto backend = render::makeSoftwareBackend();
        Renderer renderer(model.file(), *backend, {});
        const std::size_t taken = bytesOfSeveralFrames(renderer, view, quality);
        EXPECT_LE(static_cast<double>(taken), 1.05 * static_cast<double>(counted.count)) << hasSky;
        EXPECT_GE(static_cast<double>(taken), 0.8 * static_cast<double>(counted.count)) << hasSky;
        const Bytes pages = renderer.residency().statistics().committed;
        const Bytes tight{tableBytes(model.file()).count + counted.count + pages.count / 2};
        Renderer narrow(model.file(), *backend, within(tight));
        bytesOfSeveralFrames(narrow, view, quality);
        EXPECT_LE(narrow.residency().statistics().committed.count, pages.count / 2);
        narrow.render(view, quality, {});
        EXPECT_GE(narrow.residency().statistics().committed.count, pages.count) << "the room is not given back";
        Renderer none(model.file(), *backend, within({tableBytes(model.file()).count + counted.count}));
        FrameOptions several;
        several.isAccumulated = true;
        none.render(view, quality, {});
        EXPECT_THROW(none.render(view, quality, several), Error);
    }
}

// Lists of clusters grow with the model.
TEST(SlowFrameMemory, ASecondTurnAroundAMillionTrianglesAllocatesNothingLarge) {
    const tests::BuiltFile model("plant", 1000000);
    tbb::task_arena(1).execute([&] { expectNoneInTheSecondTurn(model.file(), 800); });
}

} // namespace
} // namespace gnomon::frame
