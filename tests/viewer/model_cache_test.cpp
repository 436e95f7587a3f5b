// Meshes that are looked at without a build.
#include "core/file.h"
#include "hierarchy/model_file.h"
#include "viewer/model_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

namespace gnomon::viewer {
namespace {

const CacheOptions kOptions{gibibytes(1), 1};

class ModelCache : public testing::Test {
protected:
    void SetUp() override {
        folder = testing::TempDir() + "gnomon_cache_" + testing::UnitTest::GetInstance()->current_test_info()->name();
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }

    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string file(const std::string& name) const { return folder + "/" + name; }

    static void wait(const CacheBuild& build) {
        for (int i = 0; i < 3000 && !build.isDone(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ASSERT_TRUE(build.isDone());
    }

    std::string folder;
};

/// A fan of `count` triangles.
std::string fan(int count) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count + 2) +
                       "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(count) +
                       "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
    for (int i = 0; i <= count; ++i)
        text +=
            std::to_string(1000 - i) + " " + std::to_string(i) + " " + std::to_string(std::int64_t{i} * i % 7) + "\n";
    for (int i = 1; i <= count; ++i)
        text += "3 0 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
    return text;
}

TEST_F(ModelCache, IsBesideTheMeshUnderANameOfItsOwn) {
    EXPECT_EQ(cachePath("a/scan.ply"), "a/scan.ply.gnm");
    EXPECT_TRUE(isModelPath("a/scan.ply.gnm"));
    EXPECT_FALSE(isModelPath("a/scan.ply"));
}

TEST_F(ModelCache, IsBuiltOnceAndAgainWhenTheMeshIsNewer) {
    const std::string mesh = file("scan.ply");
    writeTextFile(mesh, fan(400));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions));
    {
        const CacheBuild build(mesh, kOptions);
        wait(build);
        EXPECT_FALSE(build.failure()) << *build.failure();
        EXPECT_FALSE(build.status().stage.empty());
    }
    EXPECT_TRUE(isCacheFresh(mesh, kOptions));
    EXPECT_EQ(hierarchy::ModelFile(cachePath(mesh)).summary().sourceTriangles, 400U);
    const auto built = std::filesystem::last_write_time(cachePath(mesh));
    std::filesystem::last_write_time(mesh, built + std::chrono::seconds(1));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions));
}

TEST_F(ModelCache, IsBuiltAgainWhereItCannotBeReadOrIsOfAnotherMesh) {
    const std::string mesh = file("scan.ply");
    const auto rebuild = [&] {
        const CacheBuild build(mesh, kOptions);
        wait(build);
        EXPECT_FALSE(build.failure()) << *build.failure();
        EXPECT_TRUE(isCacheFresh(mesh, kOptions));
    };
    writeTextFile(mesh, fan(400));
    rebuild();
    std::string bytes = readTextFile(cachePath(mesh));
    std::string other = bytes;
    for (const std::size_t at : {8U, 9U, 10U, 11U}) // the version follows the magic, whatever its width
        other[at] = static_cast<char>(other[at] ^ 0x55);
    writeTextFile(cachePath(mesh), other);
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "of another version";
    rebuild();
    EXPECT_EQ(readTextFile(cachePath(mesh)), bytes);
    writeTextFile(cachePath(mesh), bytes.substr(0, bytes.size() / 2));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "cut off";
    rebuild();
    const auto built = std::filesystem::last_write_time(cachePath(mesh));
    writeTextFile(mesh, fan(401));
    std::filesystem::last_write_time(mesh, built - std::chrono::hours(1));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "of another mesh that is older, such as one that was moved here";
    rebuild();
    EXPECT_EQ(hierarchy::ModelFile(cachePath(mesh)).summary().sourceTriangles, 401U);
}

/// Gives a file other bytes of the same number, as of `when`.
void change(const std::string& path, const std::string& text, std::filesystem::file_time_type when) {
    writeTextFile(path, text);
    std::filesystem::last_write_time(path, when);
}

TEST_F(ModelCache, IsBuiltAgainAfterAChangeOfAnyFileThatWasReadWhateverItsTime) {
    const std::string mesh = file("wall.obj");
    const std::string library = file("wall.mtl");
    const std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    const auto rebuild = [&] {
        const CacheBuild build(mesh, kOptions);
        wait(build);
        ASSERT_FALSE(build.failure()) << *build.failure();
        EXPECT_TRUE(isCacheFresh(mesh, kOptions));
    };
    writeTextFile(mesh, "mtllib wall.mtl\n" + faces);
    writeTextFile(library, "newmtl a\nKd 1 0 0\n");
    rebuild();
    const std::string red = hierarchy::ModelFile(cachePath(mesh)).contentHash();
    for (const std::string& other : {mesh + ".gnm.json", mesh + ".gnm"}) {
        const std::string bytes = readTextFile(other);
        std::filesystem::remove(other);
        EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << other;
        writeTextFile(other, bytes);
        EXPECT_TRUE(isCacheFresh(mesh, kOptions)) << other;
    }
    const auto then = std::filesystem::last_write_time(library);
    change(library, "newmtl a\nKd 0 1 0\n", then - std::chrono::hours(24));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "an older library";
    rebuild();
    EXPECT_NE(hierarchy::ModelFile(cachePath(mesh)).contentHash(), red);
    change(library, "newmtl a\nKd 0 1 0\n", then - std::chrono::hours(24) + std::chrono::nanoseconds(1000));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "a time that differs";
    rebuild();
    const auto made = std::filesystem::last_write_time(mesh);
    change(mesh, "mtllib wall.mtl\n" + faces, made - std::chrono::hours(1));
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "another mesh that is older, such as one that was moved here";
    rebuild();
    writeTextFile(file("other.ply"), fan(3));
    {
        const CacheBuild build(file("other.ply"), kOptions);
        wait(build);
    }
    std::filesystem::copy_file(
        file("other.ply.gnm"), cachePath(mesh), std::filesystem::copy_options::overwrite_existing);
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "a model of another mesh in its place";
    rebuild();
    std::filesystem::remove(library);
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "a library that is gone";
    rebuild();
    writeTextFile(file("WALL.mtl"), "newmtl a\nKd 0 0 1\n");
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "a library that was missing";
    std::filesystem::remove(file("WALL.mtl"));
    std::filesystem::create_directory(file("notes"));
    writeTextFile(file("notes/other.txt"), "of no mesh");
    EXPECT_TRUE(isCacheFresh(mesh, kOptions));
    writeTextFile(file("notes/wall.mtl"), "newmtl a\nKd 0 0 1\n");
    EXPECT_FALSE(isCacheFresh(mesh, kOptions)) << "a library in a folder below";
}

TEST_F(ModelCache, IsFreshForPolygonsAndFormatsThatTellNothing) {
    const std::string quads = file("quads.ply");
    writeTextFile(
        quads,
        "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n9 9 9\n4 0 1 2 3\n4 1 4 5 2\n2 0 1\n");
    const std::string object = file("scan.obj");
    writeTextFile(object, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string& mesh : {quads, object}) {
        const CacheBuild build(mesh, kOptions);
        wait(build);
        ASSERT_FALSE(build.failure()) << *build.failure();
        EXPECT_TRUE(isCacheFresh(mesh, kOptions)) << mesh;
    }
}

TEST_F(ModelCache, AMeshThatIsNoneFailsWithAReasonAndLeavesNothing) {
    const std::string mesh = file("broken.ply");
    writeTextFile(mesh, "ply\nformat ascii 1.0\nelement vertex 3\n");
    const CacheBuild build(mesh, kOptions);
    wait(build);
    ASSERT_TRUE(build.failure());
    EXPECT_NE(build.failure()->find("broken.ply"), std::string::npos) << *build.failure();
    EXPECT_FALSE(std::filesystem::exists(cachePath(mesh)));
}

TEST_F(ModelCache, EndsWithItsOwnerAndLeavesNothingHalfWritten) {
    const std::string mesh = file("large.ply");
    writeTextFile(mesh, fan(100000));
    { const CacheBuild build(mesh, kOptions); }
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files += entry.path() == mesh || entry.path() == cachePath(mesh) || entry.path() == cachePath(mesh) + ".json"
                     ? 0
                     : 1;
    EXPECT_EQ(files, 0U);
}

} // namespace
} // namespace gnomon::viewer
