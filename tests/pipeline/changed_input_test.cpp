// A build whose input is written to while it is read: refused, whenever that happens, and nothing is left.
#include "core/error.h"
#include "core/file.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/read/open_mesh_sources.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>

#include <unistd.h>

namespace gnomon::pipeline {
namespace {

namespace fs = std::filesystem;

/// Calls `act` when the stage begins.
class AtStage final : public Progress {
public:
    AtStage(std::string name, std::string unit, std::function<void()> act)
        : name_(std::move(name)), unit_(std::move(unit)), act_(std::move(act)) {}

    void stage(std::string_view name, std::string_view unit, std::uint64_t /*total*/) override {
        if (name == name_ && unit == unit_) act_();
    }

    void advance(std::uint64_t /*count*/) override {}

private:
    std::string name_;
    std::string unit_;
    std::function<void()> act_;
};

struct Stage {
    std::string name;
    std::string unit;
    bool isOfWholePasses = false; // alone
};

/// Squares; with a strip beside them, which wants whole passes.
std::string grid(int side, bool hasStrip) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(side * side) +
                       "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                       std::to_string((side - 1) * (side - 1)) + "\nproperty list uchar int vertex_indices\n" +
                       (hasStrip ? "element tristrips 1\nproperty list int int vertex_indices\n" : "") + "end_header\n";
    for (int i = 0; i < side * side; ++i)
        text.append(std::to_string(i % side)).append(" ").append(std::to_string(i / side)).append(" 0\n");
    for (int y = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
            const int first = y * side + x;
            text += "4";
            for (const int corner : {first, first + 1, first + side + 1, first + side})
                text.append(" ").append(std::to_string(corner));
            text += "\n";
        }
    if (hasStrip) text += "3 0 1 2\n";
    return text;
}

class ChangedInput : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder); }

    void TearDown() override {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }

    /// What a build says that changes its input when a stage begins.
    std::string refusal(const Stage& stage, const std::function<void()>& change) {
        writeTextFile(mesh, grid(80, stage.isOfWholePasses));
        BuildOptions options;
        options.output = (folder / "m.gnm").string();
        options.chunkTriangles = 2000;
        AtStage progress(stage.name, stage.unit, change);
        std::string said = "nothing";
        try {
            buildModel(*read::openMeshSources({mesh}, options.memory), options, progress);
        } catch (const Error& error) {
            said = error.what();
        }
        EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1)
            << "only the mesh is left";
        return said;
    }

    fs::path folder = fs::temp_directory_path() / ("gnomon_changed_input_" + std::to_string(::getpid()));
    std::string mesh = (folder / "mesh.ply").string();
};

const std::vector<Stage> kStages = {
    {"index", "rows"},
    {"count", "faces"},
    {"count", "faces", true},
    {"measure", "vertices"},
    {"measure", "vertices", true},
    {"octree", "vertices"},
    {"octree", "vertices", true},
    {"bin", "vertices"},
    {"bin", "vertices", true},
    {"polygons", "faces", true},
    {"bin", "faces"},
    {"bin", "faces", true},
};

TEST_F(ChangedInput, ThatShrinksToNothingIsRefused) {
    for (const Stage& stage : kStages) {
        const std::string said = refusal(stage, [&] { fs::resize_file(mesh, 0); });
        EXPECT_NE(said.find("the input changed while it was read"), std::string::npos) << stage.name << " " << said;
    }
}

TEST_F(ChangedInput, ThatIsWrittenToIsRefused) {
    const auto writeOver = [&](bool hasStrip) {
        const auto later = fs::last_write_time(mesh) + std::chrono::seconds(1);
        std::string text = grid(80, hasStrip);
        text[text.size() - 2] = '0';
        File file(mesh, File::Mode::Update);
        file.writeAt(0, std::as_bytes(std::span(text)));
        fs::last_write_time(mesh, later);
    };
    for (const Stage& stage : kStages) {
        const std::string said = refusal(stage, [&] { writeOver(stage.isOfWholePasses); });
        EXPECT_NE(said.find("the input changed while it was read"), std::string::npos) << stage.name << " " << said;
    }
    EXPECT_EQ(
        refusal({"write", "pages"}, [&] { writeOver(false); }),
        mesh + ": the input changed while it was read: expected no writing "
               "to it, found a later time of change");
}

} // namespace
} // namespace gnomon::pipeline
