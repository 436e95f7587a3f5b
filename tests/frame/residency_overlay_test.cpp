// The overlay of residency: what waits for pages is yellow, what stands in for damaged ones dark red, all else blue.
#include "frame/renderer.h"
#include "render/gl/gl_backend.h"
#include "render/overlay/overlay_colors.h"
#include "render/software_backend.h"
#include "tests/support/tested_platform.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <array>
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

/// Pixels by what is said of them.
struct Colors {
    int fine = 0;
    int waiting = 0;
    int damaged = 0;
};

/// By the colours of the legend, which light makes darker; the background is of no such hue.
Colors colors(const render::Picture& picture) {
    std::array<int, 3> found{};
    for (const auto& [r, g, b] : picture.pixels) {
        const glm::vec3 hue = glm::normalize(glm::vec3(r, g, b) + 1e-6F);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (glm::distance(hue, glm::normalize(render::kResidenceColors[i])) < 0.02F) ++found[i];
    }
    return {found[0], found[1], found[2]};
}

class ResidencyOverlay : public testing::TestWithParam<std::unique_ptr<render::Backend> (*)()> {
protected:
    Colors drawn(const HillsFile& file, Waiting waiting, double errorPixels, int frames = 1) {
        const std::unique_ptr<render::Backend> backend = GetParam()();
        Renderer renderer(file.model(), *backend, {});
        plan::Quality quality;
        quality.errorPixels = errorPixels;
        FrameOptions options;
        options.waiting = waiting;
        options.overlay = render::Overlay::Residency;
        for (int i = 0; i < frames; ++i)
            lastFrame = renderer.render(view(file.model()), quality, options, lastFrame.history);
        return colors(backend->picture());
    }

    Frame lastFrame;
};

TEST_P(ResidencyOverlay, IsBlueWhereEverythingIsThere) {
    const Colors found = drawn(HillsFile(0), Waiting::UntilComplete, 0.1);
    EXPECT_EQ(lastFrame.row.pagesMissing, 0);
    EXPECT_GT(found.fine, 1000);
    EXPECT_EQ(found.waiting + found.damaged, 0);
}

TEST_P(ResidencyOverlay, IsYellowWhereFinerPagesAreAwaited) {
    const Colors found = drawn(HillsFile(0), Waiting::Never, 0.1);
    EXPECT_GT(lastFrame.row.pagesMissing, 0);
    EXPECT_GT(found.waiting, 1000);
    EXPECT_EQ(found.damaged, 0);
    const Colors content = drawn(HillsFile(0), Waiting::Never, 1e6);
    EXPECT_EQ(content.waiting + content.damaged, 0) << "nothing finer was asked for";
}

TEST_P(ResidencyOverlay, IsDarkRedWherePagesAreDamaged) {
    const HillsFile damaged(3);
    const Colors found = drawn(damaged, Waiting::UntilComplete, 0.1);
    EXPECT_GT(lastFrame.row.pagesDamaged, 0);
    EXPECT_GT(found.damaged, 50);
    EXPECT_GT(found.fine, 500);
    EXPECT_EQ(found.waiting, 0);
}

std::unique_ptr<render::Backend> residencyOnOsmesa() {
    return render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(std::nullopt), mebibytes(64));
}

INSTANTIATE_TEST_SUITE_P(Software, ResidencyOverlay, testing::Values(&render::makeSoftwareBackend));
INSTANTIATE_TEST_SUITE_P(Osmesa, ResidencyOverlay, testing::Values(&residencyOnOsmesa));

} // namespace
} // namespace gnomon::frame
