// The shadow passes: casters culled per partition against all casters, and lights and cameras that break what is naive.
#include "core/random.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shadow_triples.h"
#include "validation/frame_validation.h"
#include "validation/texel_footprint.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace gnomon::validation {
namespace {

/// What a frame came to.
struct Shot {
    frame::Frame frame;
    render::Picture picture;
    render::FloatPicture shadowDepth;
    render::Raster<render::SurfaceSample> surfaces;
};

Shot shoot(frame::Renderer& renderer, render::Backend& backend, const plan::View& view, const plan::Quality& quality) {
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    Shot shot;
    shot.frame = renderer.render(view, quality, options);
    shot.picture = backend.picture();
    shot.shadowDepth = backend.shadowDepth();
    shot.surfaces = backend.surfaces();
    return shot;
}

struct Compared {
    std::uint64_t texels = 0;
    std::uint64_t unlike = 0;
    std::string first; // of the unlike ones
};

/// Compares the depths that the lookup of one pixel reads.
void compareLookup(const Shot& a, const Shot& b, const render::SurfaceSample& surface, Compared& found) {
    const plan::FramePlan& plan = a.frame.plan;
    const plan::ShadowPass& pass = plan.passes[static_cast<std::size_t>(surface.partition())];
    const glm::dvec4 inCamera = a.frame.space.cameraFromDraw * glm::dvec4(glm::dvec3(surface.position), 1);
    const shadow::MapTexel<double> read = shadow::texelAt(shadow::cameraImage(pass.map), glm::dvec3(inCamera));
    const int width = std::max(plan.quality.filter, 1);
    const glm::dvec2 corner = glm::floor(glm::dvec2(read.column, read.row) - 0.5 * (width - 1));
    const shadow::TexelRectangle& r = pass.map.rectangle;
    for (int dy = 0; dy < width; ++dy)
        for (int dx = 0; dx < width; ++dx) {
            const int column = static_cast<int>(corner.x) + dx;
            const int row = static_cast<int>(corner.y) + dy;
            if (column < r.x || column >= r.x + r.width || row < r.y || row >= r.y + r.height) continue;
            ++found.texels;
            const float inA = a.shadowDepth.at(column, row);
            const float inB = b.shadowDepth.at(column, row);
            if (inA == inB) continue;
            if (found.unlike++ == 0)
                found.first = "texel " + std::to_string(column) + ", " + std::to_string(row) + " of slice " +
                              std::to_string(pass.map.region.slice) + ": " + std::to_string(inA) + " and " +
                              std::to_string(inB) + ", looked up at " + std::to_string(read.depth);
        }
}

std::uint64_t castersIn(const frame::Frame& frame) {
    std::uint64_t clusters = 0;
    for (const lod::DrawList& list : frame.cut.lists.casters)
        clusters += list.clusters;
    return clusters;
}

/// No depth is none, and no lookup went astray.
void expectSane(const Shot& shot) {
    for (const float depth : shot.shadowDepth.pixels)
        ASSERT_TRUE(depth >= 0 && depth <= 1) << depth;
    for (const render::SurfaceSample& surface : shot.surfaces.pixels) {
        if (!(surface.isSurface > 0)) continue;
        ASSERT_TRUE(std::isfinite(surface.partitionAndLit) && std::isfinite(surface.position.x));
    }
    for (const plan::ShadowPass& pass : shot.frame.plan.passes)
        ASSERT_TRUE(std::isfinite(pass.map.aliasingBound.x) && std::isfinite(pass.map.aliasingBound.z));
}

/// Whether there was something to cull, and it was.
enum class Culled : std::uint8_t { NoMaps, Nothing, Something };

/// Draws with and without culling: pictures, and every depth that a lookup reads, are the same to the bit.
Culled expectCullingUnseen(
    frame::Renderer& renderer, render::Backend& backend, const plan::View& view, plan::Quality quality) {
    quality.cullCasters = plan::CasterCulling::On;
    const Shot culled = shoot(renderer, backend, view, quality);
    quality.cullCasters = plan::CasterCulling::Off;
    const Shot whole = shoot(renderer, backend, view, quality);
    expectSane(culled);
    EXPECT_EQ(culled.frame.plan.passes.size(), whole.frame.plan.passes.size());
    EXPECT_TRUE(culled.picture.pixels == whole.picture.pixels);
    if (culled.frame.plan.passes.empty()) return Culled::NoMaps;
    Compared found;
    for (const render::SurfaceSample& surface : culled.surfaces.pixels)
        if (surface.isLitSide() && surface.partition() >= 0) compareLookup(culled, whole, surface, found);
    EXPECT_EQ(found.unlike, 0U) << "of " << found.texels << ": " << found.first;
    EXPECT_LE(culled.frame.row.castersKept, culled.frame.row.castersTested);
    return castersIn(culled.frame) < castersIn(whole.frame) ? Culled::Something : Culled::Nothing;
}

/// A small plant, built once.
class Plant {
public:
    Culled expectCullingUnseen(const tests::ShadowTriple& triple) {
        return validation::expectCullingUnseen(renderer_, *backend_, triple.view, triple.quality);
    }

    Shot shoot(const tests::ShadowTriple& triple) {
        return validation::shoot(renderer_, *backend_, triple.view, triple.quality);
    }

    const Box& bounds() const { return model_.file().summary().bounds; }

private:
    tests::BuiltFile model_{"plant", 20000};
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_{model_.file(), *backend_, {}};
};

void expectCullingUnseenOver(std::uint64_t first, std::uint64_t count) {
    Plant plant;
    std::uint64_t withMaps = 0;
    std::uint64_t somethingCulled = 0;
    for (std::uint64_t i = first; i < first + count; ++i) {
        SCOPED_TRACE(i);
        const tests::ShadowTriple triple = tests::shadowTriple(plant.bounds(), i, 160, 512);
        const Culled culled = plant.expectCullingUnseen(triple);
        withMaps += culled != Culled::NoMaps ? 1 : 0;
        somethingCulled += culled == Culled::Something ? 1 : 0;
    }
    EXPECT_GE(withMaps * 10, count * 8);
    EXPECT_GE(somethingCulled * 10, withMaps * 8) << "of " << withMaps;
}

TEST(PartitionCulling, IsNotSeenInAPlant) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    expectCullingUnseenOver(0, 30);
}

TEST(SlowPartitionCulling, IsNotSeenInAPlantOverManyTriples) {
    expectCullingUnseenOver(30, 300);
}

/// How far from its pixel's centre the surface of a pixel is seen, in pixels; the farthest of all pixels.
double farthestBesidePixel(const Shot& shot, const plan::View& view) {
    const CameraBasis basis = cameraBasis(view.camera);
    const glm::dvec3 eyeInDraw(glm::inverse(shot.frame.space.cameraFromDraw)[3]);
    double farthest = 0;
    for (int row = 0; row < shot.surfaces.height; ++row)
        for (int column = 0; column < shot.surfaces.width; ++column) {
            const render::SurfaceSample& surface = shot.surfaces.at(column, row);
            if (!(surface.isSurface > 0)) continue;
            const glm::dvec3 p = glm::dvec3(surface.position) - eyeInDraw;
            const double depth = glm::dot(p, basis.view);
            const double x = (glm::dot(p, basis.right) / (depth * view.tanHalfX()) + 1) / 2 * view.width;
            const double y = (1 - glm::dot(p, basis.up) / (depth * view.tanHalfY())) / 2 * view.height;
            farthest = std::max({farthest, std::abs(x - column - 0.5), std::abs(y - row - 0.5)});
        }
    return farthest;
}

// The plant has faces seen edge-on, where a ray meets the face's plane anywhere.
TEST(SurfacePoints, AreSeenAtTheirPixels) {
    Plant plant;
    for (std::uint64_t i = 90; i < 130; ++i) {
        SCOPED_TRACE(i);
        const tests::ShadowTriple triple = tests::shadowTriple(plant.bounds(), i, 160, 512);
        EXPECT_LT(farthestBesidePixel(plant.shoot(triple), triple.view), 1.0 / 64);
    }
}

/// Directions that break what divides by the sine of their angle to the view.
TEST(PartitionCulling, IsNotSeenUnderLightsAlongTheAxesAndBesideThem) {
    Plant plant;
    tests::ShadowTriple triple = tests::withDefaults(tests::shadowTriple(plant.bounds(), 1, 96, 256));
    const CameraBasis basis = cameraBasis(triple.view.camera);
    const glm::dvec3 level = glm::normalize(glm::dvec3(basis.view.x, 0, basis.view.z));
    const glm::dvec3 aside = glm::normalize(glm::cross(level, {0, 1, 0}));
    const std::array<glm::dvec3, 6> axes{basis.view, -basis.view, glm::dvec3(0, 1, 0), level, -level, aside};
    const std::array<glm::dvec3, 5> steps{
        glm::dvec3(0), basis.up * 1e-9, basis.up * -1e-9, basis.right * 1e-9, basis.right * -1e-9};
    for (const glm::dvec3& axis : axes)
        for (std::size_t around = 0; around < steps.size(); ++around) {
            triple.view.towardsLight = axis + steps[around];
            triple.quality.zPartitions = 2 + static_cast<int>(around) % 3;
            plant.expectCullingUnseen(triple);
        }
}

/// Shows that maps are no further from rays than a texel's footprint, and that nothing in them is not a number.
void expectTrueShadows(frame::DrawnModel& model, const plan::View& view, const plan::Quality& quality) {
    ValidationOptions options;
    options.groundTruth = GroundTruth::SameDetail;
    const FrameValidation proof = validate(model.renderer(), model.draw(view, quality), options);
    if (proof.truth) {
        const auto bar = 5e-4 * static_cast<double>(proof.truth->judgedPixels);
        EXPECT_LE(static_cast<double>(proof.truth->unexplainedPixels), bar);
    }
    frame::Renderer renderer(model.file(), model.backend(), {});
    expectSane(shoot(renderer, model.backend(), view, quality));
}

/// The same, and that culling is not seen. Returns what was culled.
Culled expectTrue(frame::DrawnModel& model, const plan::View& view, const plan::Quality& quality) {
    expectTrueShadows(model, view, quality);
    frame::Renderer renderer(model.file(), model.backend(), {});
    return expectCullingUnseen(renderer, model.backend(), view, quality);
}

TEST(HardLight, AlongTheAxesAndANanoradianBeside) {
    frame::DrawnModel model(frame::crateOnGround().model());
    plan::View view = frame::overGround();
    const CameraBasis basis = cameraBasis(view.camera);
    const std::array<glm::dvec3, 6> axes{
        basis.view, -basis.view, glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)};
    for (const glm::dvec3& axis : axes)
        for (const glm::dvec3& step :
             {glm::dvec3(0), basis.up * 1e-9, basis.up * -1e-9, basis.right * 1e-9, basis.right * -1e-9}) {
            view.towardsLight = axis + step;
            SCOPED_TRACE(std::to_string(axis.x) + " " + std::to_string(axis.y) + " " + std::to_string(axis.z));
            expectTrue(model, view, frame::inSlices(4));
        }
}

TEST(HardLight, ACasterBehindTheEyeInsideTheFirstSlicesWarp) {
    // Low over the ground, so that near is small and the warp's centre of projection close behind the eye; the box
    // stands beside and behind it.
    tests::SceneMesh scene = frame::crateOnGround();
    scene.addBox({2, 0, 12}, {4, 3, 16});
    frame::DrawnModel model(scene.model());
    plan::View view = frame::overGround();
    view.camera.eye = {0, 0.4, 12};
    view.camera.target = {0, 0, 0};
    view.towardsLight = {1, 1, -0.2};
    for (const auto rule : {shadow::WarpRule::Auto, shadow::WarpRule::Lspsm, shadow::WarpRule::Psm}) {
        plan::Quality quality = frame::inSlices(4);
        quality.warp.rule = rule;
        EXPECT_EQ(expectTrue(model, view, quality), Culled::Something);
    }
}

TEST(HardLight, ADepthRatioOfAMillion) {
    tests::SceneMesh scene;
    scene.addGround(100000, 64);
    for (int i = 0; i < 18; ++i) {
        const double size = 0.05 * std::exp2(i);
        scene.addBox({size * 0.2, 0, -size * 2}, {size * 0.5, size * 0.3, -size * 1.8});
    }
    frame::DrawnModel model(scene.model());
    plan::View view = frame::overGround();
    view.camera.eye = {0, 0.04, 0};
    view.camera.target = {0, 0.03, -1};
    for (const int slices : {1, 4, 8}) {
        plan::Quality quality = frame::inSlices(slices);
        quality.near = 0.05;
        quality.far = 0.05e6;
        expectTrue(model, view, quality);
    }
}

TEST(HardLight, ACameraTenMillionUnitsAway) {
    frame::DrawnModel model(frame::crateOnGround().model());
    plan::View view = frame::overGround();
    view.camera.eye = {0, 6e6, 8e6};
    view.camera.fovYRadians = 4e-7; // positions are known to more than a texel: culling is another question
    expectTrueShadows(model, view, frame::inSlices(4));
}

} // namespace
} // namespace gnomon::validation
