// GL objects in memory: what is written is read, what is incomplete is refused, and names go with their objects.
#include "core/error.h"
#include "gl/api.h"
#include "gl/context.h"
#include "gl/native_context.h"
#include "gl/objects.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace gnomon::gl {
namespace {

TEST(Texture, GivesBackWhatWasWritten) {
    const Context context(Platform::Osmesa);
    const Texture bytes(context.api(), GL_RGBA8, 5, 3);
    EXPECT_EQ(bytes.width(), 5);
    EXPECT_EQ(bytes.height(), 3);
    std::array<std::array<GLubyte, 4>, 15> texels{};
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = {static_cast<GLubyte>(i), static_cast<GLubyte>(2 * i), static_cast<GLubyte>(3 * i), 255};
    bytes.write(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    std::array<std::array<GLubyte, 4>, 15> back{};
    bytes.read(GL_RGBA, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(back)));
    EXPECT_EQ(back, texels);
    const Texture floats(context.api(), GL_R32F, 2, 2);
    const std::array<float, 4> values{0.5F, -1e30F, 0, 7};
    floats.write(GL_RED, GL_FLOAT, std::as_bytes(std::span(values)));
    std::array<float, 4> read{};
    floats.read(GL_RED, GL_FLOAT, std::as_writable_bytes(std::span(read)));
    EXPECT_EQ(read, values);
    context.check("textures");
}

TEST(Framebuffer, OfWhatDoesNotFitTogetherIsRefused) {
    const Context context(Platform::Osmesa);
    const Texture color(context.api(), GL_RGBA8, 8, 8);
    const Texture depth(context.api(), GL_DEPTH_COMPONENT32F, 8, 8);
    const std::array<const Texture*, 1> colors{&color};
    EXPECT_NE(Framebuffer(context.api(), colors, depth).id(), 0U);
    EXPECT_NE(Framebuffer(context.api(), {}, depth).id(), 0U) << "depth alone, as shadow maps have it";
    EXPECT_THROW(Framebuffer(context.api(), {}, color), Error) << "a colour is no depth";
}

TEST(BufferDeathTest, IsWrittenInPiecesAndNotPastItsEnd) {
    const Context context(Platform::Osmesa);
    const Buffer buffer(context.api(), 12);
    EXPECT_EQ(buffer.size(), 12U);
    const std::array<std::uint32_t, 2> first{1, 2};
    const std::array<std::uint32_t, 1> second{3};
    buffer.write(0, std::as_bytes(std::span(first)));
    buffer.write(8, std::as_bytes(std::span(second)));
    context.check("inside");
    EXPECT_DEATH(buffer.write(12, std::as_bytes(std::span(second))), "internal check failed");
}

TEST(Object, OfNothingOwnsNothing) {
    EXPECT_EQ(Object().id(), 0U);
    EXPECT_EQ(Buffer().id(), 0U);
    EXPECT_EQ(Texture().id(), 0U);
    EXPECT_EQ(Framebuffer().id(), 0U);
    Object empty;
    Object moved(std::move(empty));
    moved = Object();
    EXPECT_EQ(moved.id(), 0U);
}

TEST(Context, KnowsItsRendererAndItsLimits) {
    const Context context(Platform::Osmesa);
    EXPECT_NE(context.renderer(), "");
    EXPECT_GE(context.maxTextureSize(), 4096);
}

} // namespace
} // namespace gnomon::gl
