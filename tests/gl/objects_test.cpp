// GL objects in memory: what is written is read, what is incomplete is refused, and names go with their objects.
#include "core/error.h"
#include "core/random.h"
#include "gl/api.h"
#include "gl/context.h"
#include "gl/native_context.h"
#include "gl/objects.h"
#include "gl/picture_fill.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gnomon::gl {
namespace {

TEST(Texture, GivesBackWhatWasWritten) {
    const Context context(testedPlatform());
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

TEST(Texture, OfWindowPicturesHasTheirBytesInTheirOrder) {
    const Context context(testedPlatform());
    const Texture texture = Texture::ofWindowPictures(context.api(), 2, 2);
    EXPECT_EQ(texture.width(), 2);
    EXPECT_EQ(texture.height(), 2);
    const std::array<GLuint, 4> words{0xFF010203, 0xFF040506, 0xFFFFFE80, 0xFF000000};
    texture.write(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, std::as_bytes(std::span(words)));
    std::array<std::array<GLubyte, 4>, 4> back{};
    texture.read(GL_RGBA, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(back)));
    const std::array<std::array<GLubyte, 4>, 4> expected{
        {{1, 2, 3, 255}, {4, 5, 6, 255}, {255, 254, 128, 255}, {0, 0, 0, 255}}};
    EXPECT_EQ(back, expected);
    context.check("a window's picture");
}

/// A framebuffer of window pictures without depth, as a window's own is where Mesa takes its short cut.
class Target {
public:
    Target(const Context& context, int width, int height)
        : context_(context), color_(Texture::ofWindowPictures(context.api(), width, height)) {
        const Api& api = context.api();
        api.createFramebuffers(1, &id_);
        api.namedFramebufferTexture(id_, GL_COLOR_ATTACHMENT0, color_.id(), 0);
        api.bindFramebuffer(GL_FRAMEBUFFER, id_);
        api.viewport(0, 0, width, height);
    }

    ~Target() { context_.api().deleteFramebuffers(1, &id_); }

    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    Target(Target&&) = delete;
    Target& operator=(Target&&) = delete;

    /// Rows from the lowest.
    std::vector<GLuint> words() const {
        std::vector<GLuint> words(static_cast<std::size_t>(color_.width()) * static_cast<std::size_t>(color_.height()));
        color_.read(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, std::as_writable_bytes(std::span(words)));
        return words;
    }

private:
    const Context& context_;
    Texture color_;
    GLuint id_ = 0;
};

/// Fills a target `larger` times as wide and high as a picture of noise with it; by how many levels that is off.
int offBy(const Context& context, int width, int height, int larger) {
    Random random(3);
    const auto w = static_cast<std::size_t>(width);
    std::vector<GLuint> words(w * static_cast<std::size_t>(height));
    for (GLuint& word : words)
        word = 0xFF000000U | static_cast<GLuint>(random.below(1U << 24U));
    const Texture texture = Texture::ofWindowPictures(context.api(), width, height);
    texture.write(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, std::as_bytes(std::span(words)));
    texture.setFilter(larger > 1 ? GL_LINEAR : GL_NEAREST);
    const Target target(context, width * larger, height * larger);
    PictureFill(context.api(), ShaderLibrary()).draw(texture.id());
    const std::vector<GLuint> drawn = target.words();
    int max = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const int x = static_cast<int>(i % (w * static_cast<std::size_t>(larger)));
        const int y = height * larger - 1 - static_cast<int>(i / (w * static_cast<std::size_t>(larger)));
        const double u = (x + 0.5) / larger - 0.5;
        const double v = (y + 0.5) / larger - 0.5;
        const int left = static_cast<int>(std::floor(u));
        const int top = static_cast<int>(std::floor(v));
        for (unsigned c = 0; c < 24; c += 8) {
            const auto channel = [&](int column, int row) { // of the picture, rows from the upper one
                const auto at = static_cast<std::size_t>(std::clamp(row, 0, height - 1)) * w +
                                static_cast<std::size_t>(std::clamp(column, 0, width - 1));
                return static_cast<double>(words[at] >> c & 255U);
            };
            const double upper = std::lerp(channel(left, top), channel(left + 1, top), u - left);
            const double lower = std::lerp(channel(left, top + 1), channel(left + 1, top + 1), u - left);
            const auto is = static_cast<double>(drawn[i] >> c & 255U);
            max = std::max(max, static_cast<int>(std::abs(is - std::lerp(upper, lower, v - top))));
        }
    }
    return max;
}

// As large as the window it is there to the bit; in a larger one each pixel is a mix of the nearest four.
TEST(PictureFill, FillsWhatIsBoundWithThePicture) {
    const Context context(testedPlatform());
    EXPECT_EQ(offBy(context, 37, 23, 1), 0);
    EXPECT_EQ(offBy(context, 320, 200, 1), 0);
    EXPECT_LE(offBy(context, 200, 140, 2), 4);
    EXPECT_LE(offBy(context, 33, 65, 3), 4);
    context.check("a filled window");
}

TEST(Framebuffer, OfWhatDoesNotFitTogetherIsRefused) {
    const Context context(testedPlatform());
    const Texture color(context.api(), GL_RGBA8, 8, 8);
    const Texture depth(context.api(), GL_DEPTH_COMPONENT32F, 8, 8);
    const std::array<const Texture*, 1> colors{&color};
    EXPECT_NE(Framebuffer(context.api(), colors, depth).id(), 0U);
    EXPECT_NE(Framebuffer(context.api(), {}, depth).id(), 0U) << "depth alone, as shadow maps have it";
    EXPECT_THROW(Framebuffer(context.api(), {}, color), Error) << "a colour is no depth";
}

TEST(BufferDeathTest, IsWrittenInPiecesAndNotPastItsEnd) {
    const Context context(testedPlatform());
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
    const Context context(testedPlatform());
    EXPECT_NE(context.renderer(), "");
    EXPECT_GE(context.maxTextureSize(), 4096);
}

} // namespace
} // namespace gnomon::gl
