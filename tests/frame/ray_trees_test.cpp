// Trees of rays beside resident pages: within the same memory, gone with their pages, and the past leaves no mark.
#include "core/error.h"
#include "frame/renderer.h"
#include "render/software_backend.h"
#include "tests/support/made_model.h"
#include "tests/support/shadow_triples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::frame {
namespace {

const hierarchy::ModelFile& plant() {
    static const tests::BuiltFile model("plant", 20000);
    return model.file();
}

tests::ShadowTriple rayTriple(std::uint64_t index) {
    tests::ShadowTriple triple = tests::shadowTriple(plant().summary().bounds, index, 128, 256);
    triple.quality.shadows = plan::ShadowMode::Rays;
    triple.quality.errorPixels = 0.1;
    return triple;
}

/// A renderer under a memory, and its backend.
struct TreeStage {
    explicit TreeStage(Bytes memory) : renderer(plant(), *backend, {.memory = memory, .onDamaged = {}}) {}

    Frame draw(std::uint64_t index) {
        const tests::ShadowTriple triple = rayTriple(index);
        return renderer.render(triple.view, triple.quality, {});
    }

    std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    Renderer renderer;
};

/// All that a frame of the plant can need at once.
Bytes allPages() {
    Bytes bytes;
    for (const hierarchy::PageInfo& page : plant().pages())
        bytes.count += lod::decodedBytes(page).count + raytrace::keptTreeBytes(page).count;
    return bytes;
}

TEST(RayTrees, StayWithinTheMemory) {
    const Bytes tables = tableBytes(plant());
    const Bytes memory{tables.count + allPages().count / 4};
    TreeStage stage(memory);
    std::uint64_t max = 0;
    bool isBinding = false;
    for (std::uint64_t i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        const Frame frame = stage.draw(i);
        const Residency& residency = stage.renderer.residency();
        const std::uint64_t held = residency.statistics().resident.count + residency.rayTreeBytes().count;
        EXPECT_LE(tables.count + residency.statistics().committed.count, memory.count);
        EXPECT_LE(held, residency.statistics().committed.count);
        EXPECT_EQ(static_cast<std::uint64_t>(frame.row.residentBytes.value_or(0)), held);
        isBinding = isBinding || frame.residency.isBudgetBinding;
        max = std::max(max, residency.rayTreeBytes().count);
    }
    EXPECT_GT(max, allPages().count / 40);
    EXPECT_TRUE(isBinding) << "there was room: this tests nothing";
}

TEST(RayTrees, OfFramesBeforeLeaveNoMark) {
    const Bytes memory{tableBytes(plant()).count + allPages().count / 4};
    TreeStage stage(memory);
    bool isBinding = false;
    for (std::uint64_t i = 0; i < 6; ++i) {
        SCOPED_TRACE(i);
        const Frame frame = stage.draw(i);
        TreeStage fresh(memory);
        fresh.draw(i);
        EXPECT_TRUE(stage.backend->picture().pixels == fresh.backend->picture().pixels);
        isBinding = isBinding || frame.residency.isBudgetBinding;
    }
    EXPECT_TRUE(isBinding) << "there was room: this tests nothing";
}

TEST(RayTrees, GoWhereFramesHaveNoRays) {
    TreeStage stage(gibibytes(1));
    stage.draw(0);
    EXPECT_GT(stage.renderer.residency().rayTreeBytes().count, 0U);
    tests::ShadowTriple triple = rayTriple(0);
    triple.quality.shadows = plan::ShadowMode::Exact;
    stage.renderer.render(triple.view, triple.quality, {});
    EXPECT_EQ(stage.renderer.residency().rayTreeBytes().count, 0U);
}

TEST(RayTrees, MustFitBesideTheCoarsestLevel) {
    std::uint64_t roots = 0;
    for (const hierarchy::PageInfo& page : plant().pages())
        if (std::isinf(page.maxError)) roots += lod::decodedBytes(page).count;
    TreeStage stage({tableBytes(plant()).count + 2 * roots + 1});
    EXPECT_THROW(stage.draw(0), Error);
}

} // namespace
} // namespace gnomon::frame
