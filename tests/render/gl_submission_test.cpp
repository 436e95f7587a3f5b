// What a frame asks of OpenGL where nothing is waited for: few calls, all of them queued.
#include "core/error.h"
#include "gl/context.h"
#include "gl/shader_library.h"
#include "render/gl/gl_backend.h"
#include "tests/support/counted_calls.h"
#include "tests/support/field.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace gnomon::render {
namespace {

using gl::counted::Name;

/// Calls that make something, wait, or copy at once.
std::uint64_t callsThatStall() {
    std::uint64_t sum = 0;
    for (const Name name : {
             Name::finish,
             Name::createBuffers,
             Name::createTextures,
             Name::createFramebuffers,
             Name::createVertexArrays,
             Name::createQueries,
             Name::namedBufferData,
             Name::namedBufferStorage,
             Name::textureStorage2D,
             Name::namedBufferSubData,
             Name::textureSubImage2D,
             Name::getTextureImage,
             Name::linkProgram,
         })
        sum += gl::calls(name);
    return sum;
}

TEST(GlSubmission, AMovingFrameTakesFewCallsAndWaitsForNothing) {
    const Field field;
    const gl::Context context(std::make_unique<gl::CountedContext>());
    const auto backend = makeWindowBackend(context, gl::ShaderLibrary(), mebibytes(256), GlSubmission::Queues);
    for (const bool isWarm : {false, true}) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const plan::FramePlan plan = field.plan(field.view(seed), plan::Quality());
            gl::forgetCalls();
            backend->draw(field.drawing(plan));
            if (!isWarm) continue;
            EXPECT_EQ(callsThatStall(), 0U) << seed;
            EXPECT_LE(gl::allCalls(), 100U) << seed;
            EXPECT_LE(gl::calls(Name::multiDrawElementsIndirect), 5U) << "one a pass";
        }
    }
}

/// Errors, undefined behaviour and what is deprecated, as the driver reports them (KHR_debug).
TEST(GlSubmission, GivesADriverNothingToComplainOf) {
    const Field field;
    const gl::Context context(std::make_unique<gl::CountedContext>());
    const auto debugMessages =
        reinterpret_cast<PFNGLGETDEBUGMESSAGELOGPROC>(gl::counted::source("glGetDebugMessageLog"));
    ASSERT_NE(debugMessages, nullptr);
    context.api().enable(GL_DEBUG_OUTPUT);
    const auto complaints = [&] {
        std::array<char, 4096> text{};
        GLenum type = 0;
        std::vector<std::string> found;
        while (debugMessages(1, text.size(), nullptr, &type, nullptr, nullptr, nullptr, text.data()) == 1)
            if (type != GL_DEBUG_TYPE_OTHER && type != GL_DEBUG_TYPE_PERFORMANCE) found.emplace_back(text.data());
        return found;
    };
    context.api().useProgram(0xFFFF); // there is none: the log must say so, or an empty one says nothing
    EXPECT_GE(complaints().size(), 1U);
    EXPECT_THROW(context.check("the same error"), Error);
    const auto backend = makeWindowBackend(context, gl::ShaderLibrary(), mebibytes(256), GlSubmission::Queues);
    for (std::uint64_t seed = 0; seed < 22; ++seed) {
        const plan::FramePlan plan = field.plan(field.view(seed), fieldQuality(seed));
        DrawInputs frame = field.drawing(plan);
        frame.overlay = static_cast<Overlay>(seed % kOverlays.size());
        backend->draw(frame);
        EXPECT_EQ(complaints(), std::vector<std::string>()) << seed;
    }
}

TEST(GlSubmission, DrawsTheSamePictureHoweverItWaits) {
    const Field field;
    std::vector<Picture> pictures;
    std::vector<FloatPicture> depths;
    for (const GlSubmission submission :
         {GlSubmission::WaitsForEachPass, GlSubmission::WaitsForEachFrame, GlSubmission::Queues}) {
        const gl::Context context(gl::testedPlatform());
        // Little memory: what the rings hold comes round within a frame.
        const auto backend = makeWindowBackend(context, gl::ShaderLibrary(), mebibytes(48), submission);
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            const plan::FramePlan plan = field.plan(field.view(seed), plan::Quality());
            backend->draw(field.drawing(plan));
            pictures.push_back(backend->picture());
            depths.push_back(backend->shadowDepth());
        }
    }
    for (std::size_t i = 3; i < pictures.size(); ++i) {
        EXPECT_EQ(pictures[i].pixels, pictures[i % 3].pixels) << i;
        EXPECT_EQ(depths[i].pixels, depths[i % 3].pixels) << i;
    }
}

/// A context's objects have the names of another's: whoever draws or deletes has to do so in its own.
TEST(GlSubmission, BackendsOfOneProcessLeaveEachOtherAlone) {
    const Field field;
    const plan::FramePlan plan = field.plan(field.view(1), plan::Quality());
    const plan::FramePlan otherPlan = field.plan(field.view(2), plan::Quality());
    for (const gl::Platform platform : {gl::Platform::Osmesa, gl::Platform::Egl}) {
        const auto make = [&] { return makeGlBackend(platform, gl::ShaderLibrary(), mebibytes(64)); };
        auto first = make();
        first->draw(field.drawing(plan));
        const Picture alone = first->picture();
        const auto second = make();
        second->draw(field.drawing(otherPlan));
        EXPECT_EQ(first->picture().pixels, alone.pixels);
        first->draw(field.drawing(plan));
        EXPECT_EQ(first->picture().pixels, alone.pixels);
        const Picture other = second->picture();
        EXPECT_NE(other.pixels, alone.pixels);
        first.reset();
        EXPECT_EQ(second->picture().pixels, other.pixels);
        second->draw(field.drawing(otherPlan));
        EXPECT_EQ(second->picture().pixels, other.pixels);
    }
}

} // namespace
} // namespace gnomon::render
