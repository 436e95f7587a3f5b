// The overlay of residency: what waits for pages is orange, what stands in for damaged ones red, all else green.
#include "executor/gl/gl_executor.h"
#include "executor/software_executor.h"
#include "frame/renderer.h"
#include "hierarchy/tiny_model.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace gnomon::frame {
namespace {

/// Hills in a file of their own; some of their finest pages can be damaged.
class HillsFile {
public:
    explicit HillsFile(int damaged) {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = 8;
        options.clusterTriangles = 32;
        const std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("gnomon_residency_" + std::to_string(::getpid()) + ".gnm");
        tests::writeModel(tests::makeTinyModel(options), path.string());
        if (damaged > 0) damage(path, damaged);
        file_ = std::make_unique<hierarchy::ModelFile>(path.string());
        std::filesystem::remove(path); // the open file stays readable
    }

    const hierarchy::ModelFile& model() const { return *file_; }

private:
    static void damage(const std::filesystem::path& path, int count) {
        const hierarchy::ModelFile sound(path.string());
        std::fstream bytes(path, std::ios::in | std::ios::out | std::ios::binary);
        for (int i = 0; i < count; ++i) {
            const hierarchy::PageInfo& page = sound.pages()[sound.pages().size() - 1 - 5 * static_cast<std::size_t>(i)];
            const auto place = static_cast<std::streamoff>(page.offset + page.storedBytes / 2);
            bytes.seekg(place);
            const int was = bytes.get();
            bytes.seekp(place);
            bytes.put(static_cast<char>(was ^ 0x10));
        }
    }

    std::unique_ptr<hierarchy::ModelFile> file_;
};

plan::View view(const hierarchy::ModelFile& model) {
    const Box& bounds = model.summary().bounds;
    plan::View view;
    view.width = view.height = 96;
    view.camera.eye = bounds.center() + glm::length(bounds.extent()) * glm::dvec3(0.3, 0.6, 0.4);
    view.camera.target = bounds.center();
    return view;
}

struct Colors {
    int green = 0;
    int orange = 0;
    int red = 0;
    int other = 0; // but for the background, which is bluest
};

Colors colors(const executor::Picture& picture) {
    Colors result;
    for (const auto& [r, g, b] : picture.pixels) {
        if (b > r) {
            const bool isBackground = b > g;
            ++(isBackground ? result.other : result.green);
        } else if (g > r) {
            ++result.green;
        } else {
            ++(2 * g > r ? result.orange : result.red);
        }
    }
    return result;
}

class ResidencyOverlay : public testing::TestWithParam<std::unique_ptr<executor::Executor> (*)()> {
protected:
    Colors drawn(const HillsFile& file, Waiting waiting, double errorPixels, int frames = 1) {
        const std::unique_ptr<executor::Executor> executor = GetParam()();
        Renderer renderer(file.model(), *executor, {});
        plan::Quality quality;
        quality.errorPixels = errorPixels;
        FrameOptions options;
        options.waiting = waiting;
        options.overlay = executor::Overlay::Residency;
        for (int i = 0; i < frames; ++i)
            lastFrame = renderer.render(view(file.model()), quality, options);
        return colors(executor->picture());
    }

    Frame lastFrame;
};

TEST_P(ResidencyOverlay, IsGreenWhereEverythingIsThere) {
    const Colors found = drawn(HillsFile(0), Waiting::UntilComplete, 0.1);
    EXPECT_EQ(lastFrame.row.pagesMissing, 0);
    EXPECT_GT(found.green, 1000);
    EXPECT_EQ(found.orange + found.red, 0);
}

TEST_P(ResidencyOverlay, IsOrangeWhereFinerPagesAreAwaited) {
    const Colors found = drawn(HillsFile(0), Waiting::Never, 0.1);
    EXPECT_GT(lastFrame.row.pagesMissing, 0);
    EXPECT_GT(found.orange, 1000);
    EXPECT_EQ(found.red, 0);
    const Colors content = drawn(HillsFile(0), Waiting::Never, 1e6);
    EXPECT_EQ(content.orange + content.red, 0) << "nothing finer was asked for";
}

TEST_P(ResidencyOverlay, IsRedWherePagesAreDamaged) {
    const HillsFile damaged(3);
    const Colors found = drawn(damaged, Waiting::UntilComplete, 0.1);
    EXPECT_GT(lastFrame.row.pagesDamaged, 0);
    EXPECT_GT(found.red, 50);
    EXPECT_GT(found.green, 500);
    EXPECT_EQ(found.orange, 0);
}

std::unique_ptr<executor::Executor> osmesa() {
    return executor::makeGlExecutor(gl::Platform::Osmesa, gl::ShaderLibrary(std::nullopt), mebibytes(64));
}

INSTANTIATE_TEST_SUITE_P(Software, ResidencyOverlay, testing::Values(&executor::makeSoftwareExecutor));
INSTANTIATE_TEST_SUITE_P(Osmesa, ResidencyOverlay, testing::Values(&osmesa));

} // namespace
} // namespace gnomon::frame
