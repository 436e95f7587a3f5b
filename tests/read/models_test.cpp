// The real models and the nasty files against the counts that their README gives.
#include "core/error.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/read/collect.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace gnomon::read {
namespace {

std::string modelsFolder() {
    const char* given = std::getenv("GNOMON_MODELS");
    return given != nullptr ? given : GNOMON_SOURCE_DIR "/../shared/models";
}

#define SKIP_WITHOUT_MODELS()                                                                                          \
    if (!std::filesystem::exists(modelsFolder() + "/README.md"))                                                       \
    GTEST_SKIP() << "no models in " << modelsFolder() << " (set GNOMON_MODELS)"

// File name -> triangles, nothing where the table says "error".
std::map<std::string, std::optional<std::uint64_t>> nastyTable() {
    std::ifstream readme(modelsFolder() + "/README.md");
    std::map<std::string, std::optional<std::uint64_t>> table;
    std::string line;
    while (std::getline(readme, line)) {
        std::vector<std::string> cells;
        std::istringstream rest(line);
        for (std::string cell; std::getline(rest, cell, '|');)
            cells.push_back(cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "");
        if (cells.size() < 6 || !cells[1].ends_with(".ply")) continue;
        table[cells[1]] = cells[5] == "error" ? std::nullopt : std::optional(std::stoull(cells[5]));
    }
    return table;
}

TEST(ReadModels, NastyFilesGiveTheirCountOrAnError) {
    SKIP_WITHOUT_MODELS();
    const auto table = nastyTable();
    std::size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(modelsFolder() + "/nasty")) {
        const auto expected = table.find(entry.path().filename());
        ASSERT_NE(expected, table.end()) << entry.path();
        ++seen;
        try {
            const CollectedMesh mesh = collect(*openMeshSources({entry.path()}, gibibytes(1)));
            EXPECT_EQ(mesh.triangles.size(), expected->second.value_or(0)) << entry.path();
            EXPECT_GT(mesh.triangles.size(), 0U) << entry.path();
        } catch (const Error& error) {
            EXPECT_EQ(expected->second.value_or(0), 0U) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            EXPECT_NE(std::string(error.what()).find(entry.path().filename()), std::string::npos);
        }
    }
    EXPECT_EQ(seen, table.size());
}

struct RealModel {
    const char* name;
    bool isPacked;
    std::uint64_t triangles;
    std::uint64_t vertices;
};

// Else the name of the test would be the bytes of its parameter.
std::ostream& operator<<(std::ostream& out, const RealModel& model) {
    return out << model.name;
}

class ReadRealModel : public testing::TestWithParam<RealModel> {};

TEST_P(ReadRealModel, HasTheRightCounts) {
    SKIP_WITHOUT_MODELS();
    const RealModel& model = GetParam();
    std::string path = modelsFolder() + "/" + model.name;
    if (model.isPacked) {
        const std::string unpacked = testing::TempDir() + "gnomon_read_" + model.name;
        const std::string command = "xz -dc '" + path + ".xz' > '" + unpacked + "'";
        ASSERT_EQ(std::system(command.c_str()), 0);
        path = unpacked;
    }
    const auto source = openMeshSources({path}, gibibytes(1));
    const CollectedMesh mesh = collect(*source);
    EXPECT_EQ(mesh.triangles.size(), model.triangles);
    EXPECT_EQ(mesh.positions.size(), model.vertices);
    EXPECT_EQ(mesh.notAPolygon, 0U);
    if (model.isPacked) std::filesystem::remove(path);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    ReadRealModel,
    testing::Values(
        RealModel{"bim_clinic.ply", true, 1354234, 667484},
        RealModel{"bunny_10scans.ply", true, 698243, 362272},
        RealModel{"dragon_100k.ply", false, 100000, 50000},
        RealModel{"igea_tristrips.ply", false, 268686, 134345},
        RealModel{"lego_isd10030.ply", true, 4092951, 2736393}),
    [](const testing::TestParamInfo<RealModel>& model) {
        const std::string name = model.param.name;
        return name.substr(0, name.find('.'));
    });

} // namespace
} // namespace gnomon::read
