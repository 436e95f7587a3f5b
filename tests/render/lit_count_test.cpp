// The lit pixels of an image, counted by OpenGL, against those counted here.
#include "gl/context.h"
#include "render/gl/gl_backend.h"
#include "render/gl/lit_count.h"
#include "tests/support/field.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::render {
namespace {

using Texels = std::vector<std::array<std::uint8_t, 4>>;

/// The slow and obvious way.
std::uint64_t litOf(const Texels& texels) {
    const auto isLit = [](const auto& texel) { return texel[3] == 254; };
    return static_cast<std::uint64_t>(std::count_if(texels.begin(), texels.end(), isLit));
}

/// An image with alphas around the one that means lit; its texels are left in `texels`.
gl::Texture image(const gl::Api& api, int width, int height, Texels& texels) {
    texels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = {255, 254, 0, static_cast<std::uint8_t>(i * i % 7 == 2 ? 0 : 253 + i % 3)};
    gl::Texture result(api, GL_RGBA8, width, height);
    result.write(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    return result;
}

TEST(LitCount, IsThatOfTheTexels) {
    const gl::Context context(gl::testedPlatform());
    LitCount count(context.api(), gl::ShaderLibrary());
    for (const auto& [width, height] : {std::pair(1, 2), std::pair(640, 3), std::pair(37, 211), std::pair(5, 5)}) {
        Texels texels;
        const gl::Texture texture = image(context.api(), width, height, texels);
        EXPECT_EQ(count.of(texture), litOf(texels)) << width << "x" << height;
        EXPECT_GT(litOf(texels), 0U);
    }
    context.check("counting");
}

TEST(LitCount, IsGivenNowAndThenAndOnlyForTheSameShading) {
    const gl::Context context(gl::testedPlatform());
    LitCount count(context.api(), gl::ShaderLibrary());
    Texels texels;
    const gl::Texture texture = image(context.api(), 64, 48, texels);
    int given = 0;
    for (int i = 0; i < 64; ++i) {
        const std::optional<std::uint64_t> lit = count.nowAndThen(texture, plan::Shading::Lit);
        EXPECT_EQ(lit.value_or(litOf(texels)), litOf(texels));
        given += lit ? 1 : 0;
        context.api().finish(); // what was begun is known by the next call
    }
    EXPECT_GE(given, 3);
    EXPECT_LE(given, 5);
}

TEST(LitCount, OfAnImageShadedOtherwiseIsNotGiven) {
    const gl::Context context(gl::testedPlatform());
    LitCount count(context.api(), gl::ShaderLibrary());
    Texels texels;
    const gl::Texture texture = image(context.api(), 64, 48, texels);
    const bool isKnownAtOnce = count.nowAndThen(texture, plan::Shading::Lit).has_value();
    context.api().finish();
    EXPECT_TRUE(isKnownAtOnce || !count.nowAndThen(texture, plan::Shading::Headlight));
}

/// What the renderer asks: of a frame as it was drawn, whatever way it was waited for.
TEST(LitCount, OfAFrameIsThatOfItsTexture) {
    const Field field;
    const gl::Context context(gl::testedPlatform());
    const auto backend =
        makeWindowBackend(context, gl::ShaderLibrary(), mebibytes(256), GlSubmission::WaitsForEachFrame);
    std::uint64_t max = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        plan::View view = field.view(seed);
        view.width += static_cast<int>(seed % 3) * 40;
        const plan::FramePlan plan = field.plan(view, fieldQuality(seed));
        backend->draw(field.drawing(plan));
        Texels texels(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
        context.api().getTextureImage(
            backend->texture(),
            0,
            GL_RGBA,
            GL_UNSIGNED_BYTE,
            static_cast<GLsizei>(std::as_bytes(std::span(texels)).size()),
            texels.data());
        EXPECT_EQ(backend->litPixels(), litOf(texels)) << seed;
        max = std::max(max, litOf(texels));
    }
    EXPECT_GT(max, 1000U);
}

} // namespace
} // namespace gnomon::render
