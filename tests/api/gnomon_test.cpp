// The library as who links it sees it: the public header alone.
#include "api/gnomon.h"
#include "tests/support/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace gnomon::api;

/// A folder with a model of data/, gone at the end.
class Library : public testing::Test {
protected:
    static void SetUpTestSuite() {
        fs::create_directory(folder());
        build({mesh()}, path());
    }

    static void TearDownTestSuite() { fs::remove_all(folder()); }

    static std::string mesh() { return GNOMON_SOURCE_DIR "/data/models/sundial.ply"; }

    static std::string path() { return folder() / "sundial.gnm"; }

    static fs::path folder() { return fs::temp_directory_path() / ("gnomon_api_" + std::to_string(::getpid())); }
};

/// What `work` says as it fails, which has to be a std::runtime_error of one line.
template <class Work>
std::string complaintOf(const Work& work) {
    try {
        work();
    } catch (const std::runtime_error& error) {
        std::string text = error.what();
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text;
    }
    return "nothing was thrown";
}

TEST_F(Library, FailsInOneLineThatSaysWhatAndWhere) {
    const Model model(path());
    {
        const gnomon::tests::RoundingMode rounding(FE_UPWARD); // as a library that was loaded before may have left it
        EXPECT_THROW(const Model none(path()), std::runtime_error);
        EXPECT_THROW(build({mesh()}, path()), std::runtime_error);
    }
    const auto says = [](const std::string& words, const auto& work) {
        const std::string text = complaintOf(work);
        EXPECT_NE(text.find(words), std::string::npos) << text << " does not say: " << words;
    };
    says("none.gnm", [] { const Model none("none.gnm"); });
    says("sundial.ply", [] { const Model none(mesh()); });
    says("size", [&] { model.render({{"size", "0x0"}}); });
    says("colour", [&] { model.render({{"colour", "red"}}); });
    says("memory", [&] { model.render({{"memory", "1G"}}); });
    says("exact", [&] { model.plan({{"shadows", "exact"}, {"z-partitions", "4"}}); });
    says("samples", [&] { model.render({}, 0); });
    says("error", [&] { model.cutByError(-1); });
    says("error", [&] { model.cutByError(std::nan("")); });
    says("no level of detail has so few triangles", [&] { model.cutByTriangles(1); });
    says("memory", [] { build({mesh()}, folder() / "x.gnm", {.memory = 1}); });
    says("unit", [] { build({mesh()}, folder() / "x.gnm", {.unit = "yard"}); });
    says("up", [] { build({mesh()}, folder() / "x.gnm", {.up = "w"}); });
    says("input", [] { build({mesh()}, mesh()); });
    says("at least one", [] { build({}, folder() / "x.gnm"); });
    says("towardsLight", [] { shadowSchemes(1, 10, 60, 1, {0, 0, 0}); });
    says("near", [] { shadowSchemes(10, 1, 60, 1, {0, 1, 0}); });
    EXPECT_FALSE(fs::exists(folder() / "x.gnm"));
}

TEST_F(Library, ABuildEndsWhereItIsToldTo) {
    const std::string output = folder() / "stopped.gnm";
    std::set<std::string> stages;
    const auto stopped = [&] {
        build({mesh()}, output, {}, [&](const std::string& stage, std::uint64_t done, std::uint64_t total) {
            EXPECT_LE(done, total) << stage;
            stages.insert(stage);
            return stages.size() < 3;
        });
    };
    EXPECT_NE(complaintOf(stopped).find("cancelled"), std::string::npos);
    EXPECT_EQ(stages.size(), 3U);
    EXPECT_FALSE(fs::exists(output));
    std::size_t left = 0;
    for ([[maybe_unused]] const fs::directory_entry& entry : fs::directory_iterator(folder()))
        ++left;
    EXPECT_EQ(left, 1U) << "nothing but the model of the suite";
}

TEST_F(Library, AViewsCutAtNoErrorIsTheFinest) {
    const Model model(path());
    const Mesh finest = model.cutByTriangles(1'000'000);
    const Mesh seen = model.cutForView({{"error-pixels", "0.0001"}, {"size", "400x400"}});
    EXPECT_EQ(seen.triangles.size(), finest.triangles.size());
    EXPECT_GE(seen.positions.size(), finest.positions.size()) << "borders of clusters are there several times";
    const Mesh coarse = model.cutForView({{"error-pixels", "20"}, {"size", "400x400"}});
    EXPECT_LT(coarse.triangles.size(), seen.triangles.size());
    EXPECT_GT(coarse.error, seen.error);
    for (const Mesh* mesh : {&finest, &seen, &coarse}) {
        ASSERT_EQ(mesh->normals.size(), mesh->positions.size());
        ASSERT_EQ(mesh->colors.size(), mesh->positions.size() / 3 * 4);
        for (const std::uint32_t corner : mesh->triangles)
            ASSERT_LT(corner, mesh->positions.size() / 3);
    }
}

TEST_F(Library, APictureDoesNotDependOnThoseBefore) {
    const Options one{{"size", "120x90"}};
    const Options other{{"size", "120x90"}, {"eye", "3,4,-5"}, {"target", "0,0,0"}};
    const Picture alone = Model(path()).render(one, 1);
    Model model(path());
    model.render(other, 1);
    Model moved(std::move(model));
    const Picture second = moved.render(one, 1);
    ASSERT_EQ(second.width, 120);
    ASSERT_EQ(second.pixels.size(), 4U * 120 * 90);
    EXPECT_EQ(second.pixels, alone.pixels);
    EXPECT_NE(moved.render(other, 1).pixels, alone.pixels);
    EXPECT_TRUE(moved.damage().empty());
}

TEST_F(Library, APageThatIsDamagedIsTold) {
    const fs::path copy = folder() / "damaged.gnm";
    fs::copy_file(path(), copy);
    {
        std::fstream file(copy, std::ios::binary | std::ios::in | std::ios::out);
        file.seekp(static_cast<std::streamoff>(fs::file_size(copy) / 4));
        file.write("damage", 6);
    }
    std::string said;
    try {
        const Model model(copy);
        model.render({{"size", "60x60"}, {"error-pixels", "0.01"}}, 1);
        for (const std::string& line : model.damage())
            said += line;
    } catch (const std::runtime_error& error) {
        said = error.what(); // the page of the root
    }
    EXPECT_NE(said.find("damaged.gnm"), std::string::npos) << said;
    fs::remove(copy);
}

TEST(Schemes, LogarithmicMapsOnFacesNeedLeast) {
    const std::vector<ShadowScheme> schemes = shadowSchemes(1, 1000, 60, 1, {0.4, 0.8, 0.2});
    ASSERT_GT(schemes.size(), 20U);
    double min = 1e300;
    std::string warp;
    for (const ShadowScheme& scheme : schemes) {
        EXPECT_GE(scheme.maps, 1);
        EXPECT_GT(scheme.storageFactor, 0);
        if (scheme.storageFactor < min && scheme.scheme != "ZP stable") {
            min = scheme.storageFactor;
            warp = scheme.warp;
        }
    }
    EXPECT_EQ(warp, "log");
}

} // namespace
