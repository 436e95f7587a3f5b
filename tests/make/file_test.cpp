#include "core/error.h"
#include "core/file.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "tests/make/made_mesh.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace gnomon::make {
namespace {

std::string scratch(const std::string& name) {
    return testing::TempDir() + "gnomon_make_" + std::to_string(::getpid()) + "_" + name;
}

/// FNV-1a, enough to tell two files apart.
std::uint64_t hashOf(const std::string& bytes) {
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    for (const char c : bytes)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
    return hash;
}

std::string written(const MadeModel& model, int threads) {
    const std::string path = scratch(testing::UnitTest::GetInstance()->current_test_info()->name());
    NoProgress progress;
    writeMadeModel(model, path, "test", threads, progress);
    std::string bytes = readTextFile(path);
    std::filesystem::remove(path);
    return bytes;
}

TEST(MadeFile, HoldsExactlyWhatTheBlocksHold) {
    for (const std::string& kind : modelNames()) {
        const auto model = makeNamedModel(kind, 30'000, 3);
        const MadeMesh mesh = collect(*model);
        const std::string bytes = written(*model, 2);
        const std::string end = "end_header\n";
        const std::size_t header = bytes.find(end) + end.size();
        EXPECT_NE(bytes.find("element vertex " + std::to_string(mesh.vertices.size()) + "\n"), std::string::npos);
        EXPECT_NE(bytes.find("element face " + std::to_string(mesh.triangles.size()) + "\n"), std::string::npos);
        ASSERT_EQ(bytes.size(), header + 12 * mesh.vertices.size() + 13 * mesh.triangles.size());
        EXPECT_EQ(std::memcmp(bytes.data() + header, mesh.vertices.data(), 12 * mesh.vertices.size()), 0);
        const std::size_t faces = header + 12 * mesh.vertices.size();
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            std::array<std::uint32_t, 3> corners{};
            ASSERT_EQ(bytes[faces + 13 * i], 3);
            std::memcpy(corners.data(), bytes.data() + faces + 13 * i + 1, sizeof corners);
            for (std::size_t j = 0; j < 3; ++j)
                ASSERT_EQ(corners.at(j), mesh.triangles[i].at(j));
        }
    }
}

TEST(MadeFile, IsTheSameForAnyNumberOfThreads) {
    for (const std::string& kind : modelNames()) {
        const auto model = makeNamedModel(kind, 300'000, 3);
        const std::string one = written(*model, 1);
        EXPECT_EQ(one, written(*model, 2));
        EXPECT_EQ(one, written(*makeNamedModel(kind, 300'000, 3), 7));
        EXPECT_NE(one, written(*makeNamedModel(kind, 300'000, 4), 2));
    }
}

TEST(MadeFile, IsTheSameFromEveryCompilerAndBuild) {
    const auto hash = [](const std::string& kind) { return hashOf(written(*makeNamedModel(kind, 25'000, 11), 0)); };
    EXPECT_EQ(hash("statue"), 11821793455897347392U);
    EXPECT_EQ(hash("planes"), 5872727883722179405U);
    EXPECT_EQ(hash("plant"), 13305728810827281496U);
}

TEST(MadeFile, TooFewTrianglesAreRefusedWithWhatWouldDo) {
    for (const std::string& kind : modelNames())
        for (const std::uint64_t triangles : {0U, 1U, 1999U}) {
            try {
                makeNamedModel(kind, triangles, 1);
                FAIL() << kind << " of " << triangles;
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find("at least"), std::string::npos) << error.what();
            }
        }
}

/// A model with more vertices than a PLY can number; it is never made.
class EndlessModel final : public MadeModel {
public:
    std::size_t blockCount() const override { return 1; }

    MeshSize blockSize(std::size_t /*block*/) const override { return {5'000'000'000ULL, 1}; }

    void makeBlock(std::size_t /*block*/, std::uint64_t /*firstVertex*/, MeshSink& /*sink*/) const override {
        ADD_FAILURE() << "made";
    }
};

TEST(MadeFile, MoreVerticesThanIndicesCanNumberAreRefused) {
    NoProgress progress;
    EXPECT_THROW(writeMadeModel(EndlessModel(), scratch("endless"), "test", 1, progress), Error);
    EXPECT_FALSE(std::filesystem::exists(scratch("endless")));
}

/// Ctrl-C after the first block.
class StoppingProgress final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override { throw Interrupted{}; }
};

TEST(MadeFile, AnInterruptedFileLeavesNothing) {
    const std::string folder = scratch("interrupted_folder");
    std::filesystem::create_directory(folder);
    StoppingProgress progress;
    const auto model = makeNamedModel("plant", 30'000, 1);
    EXPECT_THROW(writeMadeModel(*model, folder + "/out.ply", "test", 2, progress), Interrupted);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    std::filesystem::remove(folder);
}

/// Thrown when a block has shown enough of itself.
struct StopWriting {};

/// Keeps nothing but how much it was handed at once.
class MeasuringSink final : public MeshSink {
public:
    void addVertices(std::span<const glm::vec3> positions) override { note(positions.size_bytes()); }

    void addTriangles(std::span<const MadeTriangle> triangles) override { note(triangles.size_bytes()); }

    std::size_t largest() const { return largest_; }

private:
    void note(std::size_t bytes) {
        largest_ = std::max(largest_, bytes);
        total_ += bytes;
        if (total_ > mebibytes(64).count) throw StopWriting{};
    }

    std::size_t largest_ = 0;
    std::size_t total_ = 0;
};

TEST(MadeFile, AModelOfBillionsIsMadeInSmallPieces) {
    for (const std::string& kind : modelNames()) {
        const auto model = makeNamedModel(kind, 3'000'000'000ULL, 1);
        // The first, a middle and the last block; the others are their like.
        for (const std::size_t block : {std::size_t{0}, model->blockCount() / 2, model->blockCount() - 1}) {
            MeasuringSink sink;
            try {
                model->makeBlock(block, 0, sink);
            } catch (const StopWriting&) { // the rest of it is alike
            }
            EXPECT_LE(sink.largest(), kWriteBuffer.count) << kind << " block " << block;
        }
    }
}

} // namespace
} // namespace gnomon::make
