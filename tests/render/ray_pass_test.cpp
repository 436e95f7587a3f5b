// Shadows by rays: where they begin at the samples of exact shadows they are as the integers have them, but for floats.
#include "gl/shader_library.h"
#include "render/gl/gl_backend.h"
#include "render/ray_pass.h"
#include "render/ray_shadows.h"
#include "render/software_backend.h"
#include "tests/support/field.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

namespace gnomon::render {
namespace {

const Field& field() {
    static const Field field;
    return field;
}

/// A view of the field in a light that is ever lower, to be drawn by rays.
class RayFrame {
public:
    explicit RayFrame(std::uint64_t seed) : plan_(planOf(seed)), drawing_(field().drawing(plan_)) {
        drawing_.exactCasters = drawing_.image;
        drawing_.wantsSurfaces = true;
    }

    DrawInputs& drawing() { return drawing_; }

private:
    static plan::FramePlan planOf(std::uint64_t seed) {
        plan::View view = field().view(seed);
        view.towardsLight.y = 0.4 / static_cast<double>(seed);
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Rays;
        return field().plan(view, quality);
    }

    plan::FramePlan plan_;
    DrawInputs drawing_;
};

/// The pixels of the drawn surfaces that the integers have otherwise.
std::size_t wrongPixels(RayFrame& frame, Backend& backend, std::size_t& dark) {
    const Raster<std::uint8_t> truth = litByIntegers(frame.drawing());
    const Raster<SurfaceSample> surfaces = backend.surfaces();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const SurfaceSample& surface = surfaces.pixels[i];
        const bool isLit = surface.isLitSide() && surface.litFraction() >= 0.5F;
        wrong += isLit != (truth.pixels[i] != 0) ? 1U : 0U;
        dark += surface.isLitSide() && !isLit ? 1U : 0U;
    }
    return wrong;
}

TEST(RayPass, IsAsTheIntegersHaveIt) {
    const std::unique_ptr<Backend> backend = makeSoftwareBackend();
    raytrace::KeptTrees trees; // of all frames
    std::size_t dark = 0;
    std::size_t wrong = 0;
    for (std::uint64_t seed = 1; seed < 12; ++seed) {
        RayFrame frame(seed);
        const DrawStatistics drawn = drawByRays(*backend, frame.drawing(), trees);
        EXPECT_FALSE(drawn.exact) << "rays count no casts";
        wrong += wrongPixels(frame, *backend, dark);
    }
    EXPECT_LE(wrong, 2U);
    EXPECT_GT(dark, 10000U);
}

// The statuses that a frame shows are those of its samples.
TEST(RayPass, DecidesEachSample) {
    RayFrame frame(3);
    raster::Rasterizer rasterizer;
    SoftwarePass pass;
    Picture picture(kFieldSide, kFieldSide);
    std::vector<std::uint64_t> words(picture.pixels.size());
    exact::SampleList samples;
    UnresolvedPixels unresolved;
    collectSamples(frame.drawing(), {&rasterizer, &pass, &words, &picture}, samples, unresolved);
    raytrace::KeptTrees trees;
    std::vector<raytrace::PageClusters> clusters;
    for (const lod::ClusterRange& range : frame.drawing().image->ranges)
        clusters.push_back({range.page, {&frame.drawing().pages(range.page), range.firstCluster, range.clusterCount}});
    const raytrace::CutScene scene(trees, clusters, frame.drawing().grid, frame.drawing().space.originCell);
    const std::vector<std::uint8_t> statuses = tracedStatuses(frame.drawing(), scene, samples, pass.drawn());
    ASSERT_EQ(statuses.size(), samples.size());
    const Raster<std::uint8_t> truth = litByIntegers(frame.drawing());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        wrong += (statuses[i] == exact::kLit) != (truth.pixels[samples.pixel[i]] != 0) ? 1U : 0U;
    EXPECT_LE(wrong, 1U);
    EXPECT_GT(samples.size(), 1000U);
}

// Rays of OpenGL begin off surfaces that floats tell of: less true in light as low as this.
TEST(RayPass, OpenGlBeginsOffItsSurfaces) {
    const std::unique_ptr<Backend> gl = makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), mebibytes(64));
    raytrace::KeptTrees trees;
    std::size_t wrong = 0;
    std::size_t dark = 0;
    for (std::uint64_t seed = 8; seed < 11; ++seed) {
        RayFrame frame(seed);
        const DrawStatistics drawn = drawByRays(*gl, frame.drawing(), trees);
        wrong += wrongPixels(frame, *gl, dark);
        EXPECT_EQ(drawn.image.drawCalls, drawn.shadows.drawCalls) << "the image is drawn once for each";
    }
    EXPECT_GT(dark, 10000U);
    EXPECT_LE(wrong * 10, dark);
}

} // namespace
} // namespace gnomon::render
