// Sections and the ground: pictures against plain lines of sight that meet every triangle, caps against how often a
// line comes out of what is solid, shadows against rays.
#include "core/random.h"
#include "frame/ground.h"
#include "frame/renderer.h"
#include "render/exact_pass.h"
#include "render/ray_shadows.h"
#include "render/software_backend.h"
#include "render/view/cap_buffers.h"
#include "render/view/drawn_cluster.h"
#include "render/view/image_projection.h"
#include "render/view/section_caps.h"
#include "render/view/section_cut.h"
#include "render/view/section_lines.h"
#include "render/view/section_memory.h"
#include "tests/support/made_model.h"
#include "validation/frame_validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::validation {
namespace {

constexpr int kSectionSide = 128;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// A model, its renderer and all triangles of its finest level.
class SectionStage {
public:
    SectionStage(const std::string& kind, std::uint64_t triangles) : model_(kind, triangles) {}

    const Box& bounds() const { return model_.file().summary().bounds; }

    frame::Frame render(const plan::View& view, plan::Quality quality, bool wantsSurfaces = false) {
        quality.errorPixels = 0;
        frame::FrameOptions options;
        options.wantsSurfaces = wantsSurfaces;
        return renderer_.render(view, quality, options);
    }

    /// A picture by a renderer that has drawn nothing before, or by the one that has drawn all the others.
    render::Picture picture(const plan::View& view, const plan::Quality& quality, bool isFresh) {
        frame::Renderer fresh(model_.file(), *backend_, {});
        (isFresh ? fresh : renderer_).render(view, quality, {});
        return backend_->picture();
    }

    /// How much of the picture of an exact frame, the last one, changes where integers decide its shadows one by one.
    double changedByIntegers(const frame::Frame& frame) {
        const render::Picture exact = backend_->picture();
        render::DrawInputs drawing = renderer_.drawing(frame, {});
        drawing.exactCasters = &frame.cut.lists.casters[0];
        const render::Raster<std::uint8_t> lit = render::litByIntegers(drawing);
        drawing.litMask = &lit;
        backend_->drawImage(drawing);
        return render::difference(backend_->picture(), exact).changedFraction;
    }

    render::Backend& backend() { return *backend_; }

    frame::Renderer& renderer() { return renderer_; }

private:
    tests::BuiltFile model_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_{model_.file(), *backend_, {}};
};

using Corners = std::array<glm::dvec3, 3>;

/// The finest triangles, world space.
std::vector<Corners> trianglesOf(SectionStage& stage) {
    plan::View view; // from where all is seen
    view.camera.target = stage.bounds().center();
    view.camera.eye = view.camera.target + 4 * glm::length(stage.bounds().extent()) * glm::dvec3(0.5, 0.6, 0.7);
    view.width = view.height = 16;
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Off;
    const frame::Frame frame = stage.render(view, quality);
    const render::DrawInputs drawing = stage.renderer().drawing(frame, {});
    std::vector<Corners> triangles;
    for (const lod::ClusterRange& range : drawing.image->ranges) {
        const hierarchy::Page& page = drawing.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
                Corners corners{};
                for (std::size_t k = 0; k < 3; ++k)
                    corners.at(k) = drawing.grid.world(
                        page.vertices[cluster.firstVertex + page.triangles[cluster.firstTriangle + t].at(k)].position);
                triangles.push_back(corners);
            }
        }
    }
    return triangles;
}

/// Where the line from `eye` along `way` meets a triangle; never where it does not.
double hitOf(const Corners& p, const glm::dvec3& eye, const glm::dvec3& way) {
    const glm::dvec3 a = p[1] - p[0];
    const glm::dvec3 b = p[2] - p[0];
    const glm::dvec3 h = glm::cross(way, b);
    const double determinant = glm::dot(a, h);
    if (determinant == 0) return kNever;
    const glm::dvec3 s = eye - p[0];
    const double u = glm::dot(s, h) / determinant;
    const glm::dvec3 q = glm::cross(s, a);
    const double v = glm::dot(way, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(b, q) / determinant : kNever;
}

bool isKept(const plan::View& view, const glm::dvec3& p) {
    return std::all_of(
        view.sections.begin(), view.sections.end(), [&](const Plane& plane) { return plane.signedDistance(p) >= 0; });
}

/// A view of a model with one to three sections through it.
plan::View sectionedView(const Box& bounds, Random& random) {
    plan::View view;
    view.width = view.height = kSectionSide;
    view.camera.target = bounds.center();
    const glm::dvec3 aside(random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1));
    view.camera.eye = bounds.center() + 0.9 * glm::length(bounds.extent()) * glm::normalize(aside);
    view.towardsLight = {random.uniform(-1, 1), random.uniform(0.3, 1), random.uniform(-1, 1)};
    if (random.below(3) == 0) view.camera.projection = Projection::Orthographic;
    for (std::uint64_t i = 0; i <= random.below(3); ++i) {
        glm::dvec3 normal(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        normal = glm::normalize(i == 0 ? view.camera.eye - view.camera.target + 0.7 * normal : normal);
        const glm::dvec3 point = bounds.center() + 0.15 * bounds.extent() * random.uniform(-1, 1);
        view.sections.push_back({-normal, glm::dot(normal, point)});
    }
    return view;
}

/// What a line of sight sees of a model with sections.
struct PlainSight {
    double depth = kNever; // of the nearest kept triangle
    double enters = 0;     // where the last plane lets it in
    int around = 0; // how often what is solid lies around there: the surfaces that it leaves less those it enters
};

PlainSight plainSight(
    const plan::View& view, const std::vector<Corners>& triangles, const glm::dvec3& eye, const glm::dvec3& way) {
    PlainSight sight;
    for (const Plane& plane : view.sections)
        if (const double slope = glm::dot(plane.normal, way); slope > 0)
            sight.enters = std::max(sight.enters, -plane.signedDistance(eye) / slope);
    for (const Corners& p : triangles) {
        const double at = hitOf(p, eye, way);
        if (!(at >= sight.enters) || at == kNever) continue;
        sight.around += glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), way) > 0 ? 1 : -1;
        if (isKept(view, eye + way * (at * (1 + 1e-12)))) sight.depth = std::min(sight.depth, at);
    }
    if (!isKept(view, eye + way * (sight.enters * (1 + 1e-9) + 1e-12))) sight.around = 0;
    return sight;
}

PlainSight sightOfPixel(const plan::View& view, const std::vector<Corners>& triangles, int x, int y) {
    const CameraBasis basis = cameraBasis(view.camera);
    const double half = halfHeightAtTarget(view.camera);
    const glm::dvec2 at((2 * x + 1.0) / kSectionSide - 1, 1 - (2 * y + 1.0) / kSectionSide);
    const double distance = glm::length(view.camera.target - view.camera.eye);
    const glm::dvec3 aside = toWorld(basis, {at.x * half, at.y * half, 0});
    // Lines begin before the model, whatever lies behind the eye.
    if (view.camera.isParallel()) return plainSight(view, triangles, view.camera.eye + aside, basis.view);
    return plainSight(view, triangles, view.camera.eye, basis.view + aside / distance);
}

bool isSameDepth(double found, double wanted, double tolerance) {
    return std::isfinite(wanted) ? std::abs(found - wanted) < tolerance : std::isinf(found);
}

void expectPlainSections(const char* kind, std::uint64_t triangleCount, bool isClosed) {
    SectionStage stage(kind, triangleCount);
    const std::vector<Corners> triangles = trianglesOf(stage);
    const double size = glm::length(stage.bounds().extent());
    Random random(8);
    int capped = 0;
    for (int trial = 0; trial < 8; ++trial) {
        const plan::View view = sectionedView(stage.bounds(), random);
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Off;
        quality.look.shading = plan::Shading::Unlit;
        const frame::Frame frame = stage.render(view, quality);
        const render::FloatPicture depth = stage.backend().viewDepth();
        int unlike = 0;
        int looked = 0;
        for (int y = 1; y < kSectionSide; y += 3)
            for (int x = 1; x < kSectionSide; x += 3) {
                const PlainSight sight = sightOfPixel(view, triangles, x, y);
                const bool isCap = isClosed && sight.around != 0 && sight.enters > 0;
                const double wanted = isCap ? sight.enters : sight.depth;
                const double found = depth.at(x, y);
                capped += static_cast<int>(isCap);
                ++looked;
                unlike += static_cast<int>(!isSameDepth(found, wanted, 2e-3 * size));
            }
        // At edges, and on lines that are drawn a pixel wide.
        EXPECT_LE(unlike, looked / 12) << trial;
    }
    EXPECT_TRUE(!isClosed || capped > 500) << capped;
}

TEST(Sections, ShowWhatPlainLinesMeetAndCapWhatIsSolid) {
    expectPlainSections("statue", 3000, true);
}

TEST(Sections, ShadowsOfExactDecisionsAreThoseOfRays) {
    SectionStage stage("statue", 20000);
    Random random(9);
    double changed = 0;
    for (int trial = 0; trial < 8; ++trial) {
        plan::View view = sectionedView(stage.bounds(), random);
        if (trial % 2 == 1) view.sections = {{{0, -1, 0}, stage.bounds().center().y}}; // what is above is gone
        view.cutsCasters = trial % 2 == 0;
        plan::Quality quality;
        quality.look.shading = plan::Shading::Lit;
        quality.shadows = plan::ShadowMode::Exact;
        const frame::Frame frame = stage.render(view, quality);
        const render::Picture exact = stage.backend().picture();
        EXPECT_EQ(stage.changedByIntegers(frame), 0) << trial;
        quality.shadows = plan::ShadowMode::Rays;
        stage.render(view, quality);
        EXPECT_LE(render::difference(stage.backend().picture(), exact).changedFraction, 2e-3) << trial;
        quality.shadows = plan::ShadowMode::Maps;
        stage.render(view, quality);
        EXPECT_LE(render::difference(stage.backend().picture(), exact).changedFraction, 0.06) << trial;
        plan::View other = view;
        other.cutsCasters = !view.cutsCasters;
        quality.shadows = plan::ShadowMode::Exact;
        stage.render(other, quality);
        changed += render::difference(stage.backend().picture(), exact).changedFraction;
    }
    EXPECT_GT(changed, 1e-3) << "what is cut away casts, or does not";
}

constexpr double kNearlyTouchingPixels = 0.02; // for rays beside integers, which begin two cells off

/// How many of the pixels of the last frame that face the light get another verdict from rays than from integers, a
/// share.
double raysUnlikeIntegers(SectionStage& stage, const frame::Frame& frame) {
    render::DrawInputs drawing = stage.renderer().drawing(frame, {});
    drawing.exactCasters = &frame.cut.lists.casters[0];
    const render::Raster<render::SurfaceSample> surfaces = stage.backend().surfaces();
    const std::array lists = {drawing.image, drawing.exactCasters};
    const std::vector<raytrace::Light> light =
        render::lightByRays(render::rayScene(drawing, lists), drawing, surfaces, kNearlyTouchingPixels);
    const render::Raster<std::uint8_t> lit = render::litByIntegers(drawing);
    double unlike = 0;
    double looked = 1;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (light[i] != raytrace::Light::Lit && light[i] != raytrace::Light::Dark) continue;
        ++looked;
        unlike += (light[i] == raytrace::Light::Lit) != (lit.pixels[i] != 0) ? 1 : 0;
    }
    EXPECT_GT(looked, 100);
    return unlike / looked;
}

// What maps are held against: rays through what the sections leave, at the frame's detail and at the finest.
TEST(Sections, AreCutForTheRaysOfOraclesToo) {
    SectionStage stage("statue", 20000);
    Random random(17);
    for (int trial = 0; trial < 4; ++trial) {
        plan::View view = sectionedView(stage.bounds(), random);
        view.width = view.height = 2 * kSectionSide;
        if (trial % 2 == 1) view.sections = {{{0, -1, 0}, stage.bounds().center().y}};
        view.cutsCasters = trial % 3 != 2;
        plan::Quality quality;
        quality.look.shading = plan::Shading::Lit;
        quality.shadows = plan::ShadowMode::Exact;
        EXPECT_LE(raysUnlikeIntegers(stage, stage.render(view, quality, true)), 0.01) << trial;
        quality.shadows = plan::ShadowMode::Maps;
        for (const GroundTruth groundTruth : {GroundTruth::SameDetail, GroundTruth::FullDetail}) {
            ValidationOptions options;
            options.groundTruth = groundTruth;
            const FrameValidation proof = validate(stage.renderer(), stage.render(view, quality), options);
            ASSERT_TRUE(proof.truth) << trial;
            EXPECT_GT(proof.truth->shadows.litSidePixels, 100U) << trial;
            EXPECT_LE(proof.truth->shadows.wrongFraction, 0.12) << trial;
            EXPECT_LE(proof.truth->unexplainedFraction(), 0.01) << trial;
        }
    }
}

TEST(Sections, DrawTheSameWhateverWasCutBefore) {
    SectionStage stage("statue", 20000);
    Random random(14);
    plan::View view = sectionedView(stage.bounds(), random);
    for (int trial = 0; trial < 24; ++trial) {
        const plan::View other = sectionedView(stage.bounds(), random);
        if (trial % 2 == 0) view.camera = other.camera; // the planes stay, and what is near them is another detail
        if (trial % 3 == 0) view.sections = other.sections;
        if (trial % 5 == 0) view.width = view.height = kSectionSide / 2 + static_cast<int>(random.below(100));
        plan::Quality quality;
        quality.shadows = trial % 4 < 2 ? plan::ShadowMode::Maps : plan::ShadowMode::Exact;
        quality.errorPixels = random.uniform(0.3, 8);
        const render::Picture kept = stage.picture(view, quality, false);
        EXPECT_EQ(render::difference(stage.picture(view, quality, true), kept).changedFraction, 0) << trial;
    }
}

/// Whether the level plane at the height `lowest` is in shadow where that pixel shows it.
bool isGroundShadowed(const plan::View& view, const std::vector<Corners>& triangles, double lowest, int x, int y) {
    const glm::dvec3 way = toWorld(
        cameraBasis(view.camera),
        {((2 * x + 1.0) / kSectionSide - 1) * view.tanHalfX(),
         (1 - (2 * y + 1.0) / kSectionSide) * view.tanHalfY(),
         1});
    const double at = (lowest - view.camera.eye.y) / way.y;
    if (!(at > 0)) return false;
    const glm::dvec3 light = view.light().unit();
    return std::any_of(triangles.begin(), triangles.end(), [&](const Corners& p) {
        const double met = hitOf(p, view.camera.eye + way * at, light);
        return met > 0 && met != kNever;
    });
}

TEST(Ground, ShowsTheShadowThatPlainRaysFind) {
    SectionStage stage("statue", 3000);
    const std::vector<Corners> triangles = trianglesOf(stage);
    const double lowest = stage.bounds().min.y;
    Random random(10);
    int shadowed = 0;
    for (int trial = 0; trial < 6; ++trial) {
        plan::View view = sectionedView(stage.bounds(), random);
        view.sections.clear();
        view.camera.projection = Projection::Perspective;
        plan::Quality quality;
        quality.look.background = {plan::Background::Kind::Color, {200, 200, 200}};
        quality.shadows = trial % 2 == 0 ? plan::ShadowMode::Exact : plan::ShadowMode::Maps;
        stage.render(view, quality);
        const render::Picture without = stage.backend().picture();
        const render::FloatPicture depth = stage.backend().viewDepth();
        quality.look.ground = true;
        stage.render(view, quality);
        const render::Picture with = stage.backend().picture();
        quality.look.background = {plan::Background::Kind::Transparent, {}};
        stage.render(view, quality);
        const render::Coverage coverage = stage.backend().coverage();
        int unlike = 0;
        int looked = 0;
        for (int y = 0; y < kSectionSide; y += 2)
            for (int x = 0; x < kSectionSide; x += 2) {
                if (std::isfinite(depth.at(x, y))) continue;
                ++looked;
                const bool isDark = isGroundShadowed(view, triangles, lowest, x, y);
                shadowed += static_cast<int>(isDark);
                const bool isDrawnDark = with.at(x, y)[0] < 200;
                unlike += static_cast<int>(isDark != isDrawnDark || isDrawnDark != (coverage.at(x, y) > 0));
                EXPECT_EQ(without.at(x, y)[0], 200);
            }
        EXPECT_LE(unlike, looked / 50) << trial;
    }
    EXPECT_GT(shadowed, 500);
}

} // namespace
} // namespace gnomon::validation
