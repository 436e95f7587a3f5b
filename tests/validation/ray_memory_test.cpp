// Rays against the finest level: whole or refused, and counted in the memory that there is.
#include "core/error.h"
#include "render/software_backend.h"
#include "tests/support/made_model.h"
#include "tests/support/shadow_triples.h"
#include "validation/frame_validation.h"
#include "validation/ray_memory.h"

#include <gtest/gtest.h>

#include <fstream>

namespace gnomon::validation {
namespace {

/// A model and what its finest level seen whole is held against.
class FullGroundTruth : public testing::Test {
protected:
    static constexpr std::uint64_t kTriangles = 60000;

    tests::ShadowTriple triple() const {
        return withDefaults(tests::shadowTriple(model.file().summary().bounds, 0, 128, 256));
    }

    /// The share of wrong pixels under a memory, or the line that refuses it.
    struct Answer {
        double wrong = -1;
        std::string refusal;
    };

    Answer answer(Bytes memory) const {
        const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
        frame::Renderer renderer(model.file(), *backend, {.memory = memory, .onDamaged = {}});
        const frame::Frame frame = renderer.render(triple().view, triple().quality, {});
        ValidationOptions options;
        options.groundTruth = GroundTruth::FullDetail;
        try {
            return {validate(renderer, frame, options).truth.value().shadows.wrongFraction, {}};
        } catch (const Error& error) {
            return {-1, error.what()};
        }
    }

    const tests::BuiltFile model{"plant", kTriangles};
};

TEST_F(FullGroundTruth, RefusesWhatTheMemoryDoesNotHoldAndNamesWhatWouldDo) {
    const Answer whole = answer(gibibytes(1));
    ASSERT_EQ(whole.refusal, "");
    const Answer partial = answer(mebibytes(1)); // less than the pages alone take
    EXPECT_EQ(partial.wrong, -1);
    const std::size_t figure = partial.refusal.find("at least ");
    ASSERT_NE(figure, std::string::npos) << partial.refusal;
    const Bytes sufficient =
        parseBytes(partial.refusal.substr(figure + 9, partial.refusal.find(',') - figure - 9)).value();
    EXPECT_GT(sufficient.count, kTriangles * 83 / 2);
    EXPECT_EQ(answer(sufficient).wrong, whole.wrong);
    const Answer withoutRays = answer({sufficient.count / 3}); // the pages fit, the rays beside them do not
    EXPECT_NE(withoutRays.refusal.find("rays against it take more than the page memory"), std::string::npos);
}

TEST_F(FullGroundTruth, KeepsRoomForItsRays) {
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    const auto prepared = [&](frame::Renderer& renderer) {
        plan::Quality quality = triple().quality;
        quality.shadows = plan::ShadowMode::Exact;
        quality.errorPixels = 0;
        return renderer.prepare(triple().view, quality);
    };
    frame::Renderer ample(model.file(), *backend, {});
    const MemoryWithRays needed = memoryWithRays(ample, prepared(ample));
    frame::Renderer tight(model.file(), *backend, {.memory = needed.all(), .onDamaged = {}});
    plan::View elsewhere = triple().view;
    std::swap(elsewhere.camera.eye, elsewhere.camera.target);
    tight.render(elsewhere, triple().quality, {}); // leaves pages that the oracle has no use for
    const frame::PreparedFrame fine = prepared(tight);
    const RayMemory memory(tight, fine);
    const Bytes tables = tight.residency().bytesWith({});
    EXPECT_LE(tight.residency().statistics().resident.count + tables.count + needed.rays.count, needed.all().count);
}

TEST_F(FullGroundTruth, RefusesAFinestLevelThatIsDamaged) {
    const hierarchy::PageInfo& last = model.file().pages().back();
    ASSERT_EQ(last.level, 0U);
    std::fstream file(model.file().path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(last.offset + last.storedBytes / 2));
    file.put('\x5A');
    file.put('\xA5');
    file.close();
    EXPECT_NE(answer(gibibytes(1)).refusal.find("is damaged"), std::string::npos);
}

} // namespace
} // namespace gnomon::validation
