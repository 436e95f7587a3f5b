#include "core/error.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "gl/program.h"
#include "gl/window.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

namespace gnomon::gl {
namespace {

/// Writes two shaders that fill the lower left triangle of the viewport with one colour.
std::string shaderFolder(const std::string& fragment) {
    std::string folder =
        testing::TempDir() + "gnomon_gl_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/a.vert") << "layout(location = 0) in uvec2 position;\n"
                                         "void main() { gl_Position = vec4(vec2(position) - 1.0, 0.25, 1.0); }\n";
    std::ofstream(folder + "/a.frag") << fragment;
    return folder;
}

/// Draws a triangle over half of an 8x8 image and returns how many pixels it covered.
int coveredPixels(Platform platform) {
    const Context context(platform);
    const Api& api = context.api();
    const ShaderLibrary library(
        shaderFolder("layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0, 0.0, 0.0, 1.0); }\n"));
    const Program program(api, library, "a.vert", "a.frag");
    const Texture color(api, GL_RGBA8, 8, 8);
    const Texture depth(api, GL_DEPTH_COMPONENT32F, 8, 8);
    const std::array<const Texture*, 1> colors = {&color};
    const Framebuffer target(api, colors, depth);
    const Buffer buffer(api, 64);
    const std::array<GLuint, 9> words = {0, 0, 2, 0, 0, 2, 0, 1, 2};
    buffer.write(0, std::as_bytes(std::span(words)));
    const std::array<Attribute, 1> attributes = {Attribute{0, 2, GL_UNSIGNED_INT, true, 0}};
    const std::array<VertexStream, 1> streams = {VertexStream{0, 8}};
    const VertexArray vertices(api, buffer, streams, attributes);

    api.bindFramebuffer(GL_FRAMEBUFFER, target.id());
    api.viewport(0, 0, 8, 8);
    const std::array<float, 4> black{};
    api.clearNamedFramebufferfv(target.id(), GL_COLOR, 0, black.data());
    api.useProgram(program.id());
    api.bindVertexArray(vertices.id());
    const GLsizei count = 3;
    const void* const offset = reinterpret_cast<const void*>(24);
    const GLint base = 0;
    api.multiDrawElementsBaseVertex(GL_TRIANGLES, &count, GL_UNSIGNED_INT, &offset, 1, &base);
    std::array<std::array<GLubyte, 4>, 64> pixels{};
    color.read(GL_RGBA, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(pixels)));
    context.check("test");
    int covered = 0;
    for (const auto& pixel : pixels)
        covered += pixel[0] == 255 ? 1 : 0;
    return covered;
}

TEST(Context, OsmesaDrawsATriangleOfAPool) {
    // Half of 64 pixels: the diagonal's centres belong to one side or the other by the fill rule.
    const int covered = coveredPixels(Platform::Osmesa);
    EXPECT_GE(covered, 28);
    EXPECT_LE(covered, 36);
}

TEST(Context, EglDrawsTheSame) {
    EXPECT_EQ(coveredPixels(Platform::Egl), coveredPixels(Platform::Osmesa));
}

TEST(Context, OsmesaIsNoHardware) {
    const Context context(Platform::Osmesa);
    EXPECT_FALSE(context.isHardware());
    EXPECT_GE(context.maxTextureSize(), 8192);
}

TEST(Context, AnErrorIsThrownWithItsPlace) {
    const Context context(testedPlatform());
    context.api().enable(0xFFFF);
    try {
        context.check("the test");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("the test"), std::string::npos);
    }
    EXPECT_NO_THROW(context.check("afterwards"));
}

TEST(Program, AShaderThatDoesNotCompileIsNamedWithTheLog) {
    const Context context(testedPlatform());
    const ShaderLibrary library(shaderFolder("void main() { nonsense; }\n"));
    try {
        const Program program(context.api(), library, "a.vert", "a.frag");
        FAIL() << "it compiled";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("a.frag"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos);
    }
}

TEST(Object, MovesAndDeletesOnce) {
    const Context context(testedPlatform());
    Buffer a(context.api(), 16);
    const GLuint name = a.id();
    Buffer b(std::move(a));
    EXPECT_EQ(b.id(), name);
    a = Buffer(context.api(), 32);
    EXPECT_NE(a.id(), name);
    b = std::move(a);
    EXPECT_EQ(b.size(), 32U);
    context.check("moves");
}

TEST(Window, WithoutADisplaySaysSo) {
    ::unsetenv("DISPLAY");
    try {
        const Window window("test", 64, 64);
        FAIL() << "a window opened";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no display"), std::string::npos);
    }
}

} // namespace
} // namespace gnomon::gl
