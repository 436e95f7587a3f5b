#include "core/error.h"
#include "gl/shader_library.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace gnomon::gl {
namespace {

TEST(ShaderLibrary, EmbeddedTextIsTheFilesText) {
    const ShaderLibrary embedded;
    const ShaderLibrary folder(std::string(GNOMON_SOURCE_DIR) + "/shaders");
    for (const auto& [path, text] : kEmbeddedShaders) {
        EXPECT_FALSE(text.empty()) << path;
        EXPECT_EQ(embedded.source(path), folder.source(path)) << path;
    }
}

TEST(ShaderLibrary, IncludesOnceAndPutsVersionAndDefinesFirst) {
    const std::string folder = testing::TempDir() + "gnomon_shader_library_" + std::to_string(::getpid());
    std::filesystem::create_directories(folder + "/sub");
    std::ofstream(folder + "/a.glsl") << "#include \"sub/b.glsl\"\n#include \"sub/b.glsl\"\na\n";
    std::ofstream(folder + "/sub/b.glsl") << "#include \"a.glsl\"\nb\n";
    EXPECT_EQ(ShaderLibrary(folder).source("a.glsl", "#define X 1\n"), "#version 450 core\n#define X 1\nb\na\n");
}

TEST(ShaderLibrary, AMissingFileIsNamed) {
    EXPECT_THROW(ShaderLibrary().source("no/such.frag"), Error);
    EXPECT_THROW(ShaderLibrary("/no/such/folder").source("a.frag"), Error);
}

} // namespace
} // namespace gnomon::gl
