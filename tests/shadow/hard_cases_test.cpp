// The hard cases of the shadow theory; docs/hard_cases.md shows this table.
#include "core/error.h"
#include "float_error.h"
#include "shadow/quantized_near.h"
#include "tests/support/hard_cases.h"
#include "tests/support/random_views.h"

namespace gnomon::shadow {
namespace {

bool isFinite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

/// Every map of every kind of scheme is finite, and the corners and middle of the frustum lie in one.
void expectSound(const ShadowView& view) {
    for (int kind = 0; kind < 6; ++kind) {
        ShadowOptions options;
        options.scheme.faces = (kind & 1) != 0;
        options.scheme.nearFace = (kind & 2) != 0 ? NearFace::Stretch : NearFace::OwnMap;
        options.stabilized = kind == 4;
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        for (const ShadowMap& map : setup.maps)
            EXPECT_TRUE(isFinite(map.lightClipFromCamera()) && std::isfinite(map.aliasingBound.worst()));
        for (const glm::dvec3& p : corners(view.frustum)) {
            const glm::dvec4 clip = setup.maps.at(setup.mapOf(p)).lightClipFromCamera() * glm::dvec4(p, 1);
            EXPECT_GT(clip.w, 0);
            EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w);
        }
    }
}

ShadowView viewWithLight(const glm::dvec3& towardsLight) {
    ShadowView view;
    view.towardsLight = glm::normalize(towardsLight);
    return view;
}

void lightParallel() {
    expectSound(viewWithLight({0, 0, -1}));
    expectSound(viewWithLight({0, 0, 1}));
    for (const glm::dvec3& light : {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1)})
        EXPECT_EQ(kappaAuto(fitSlice(lightFrame(light), {})), 0);
}

void lightNearlyParallel() {
    for (const double angle : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
        const glm::dvec3 light(std::sin(angle), 0, -std::cos(angle));
        EXPECT_NEAR(sinLightAngle(light) / std::sin(angle), 1, 1e-9);
        expectSound(viewWithLight(light));
    }
}

void spinningOrientation() {
    // A hundredth of a degree to one side of the view, then to the other: the plain frame turns by half a turn.
    const double angle = 1e-4;
    const glm::dvec3 before(0, std::sin(angle), -std::cos(angle));
    const glm::dvec3 after(0, -std::sin(angle), -std::cos(angle));
    EXPECT_LT(glm::dot(lightFrame(before).z, lightFrame(after).z), -0.9);
    const ViewFrustum frustum;
    const OrientationState state{before, chosenFrame(frustum, before, {}, std::nullopt).z};
    EXPECT_GT(glm::dot(chosenFrame(frustum, after, {}, state).z, state.zAxis), 0.9999);
}

void lightOverhead() {
    expectSound(viewWithLight({0, 1, 0}));
    expectSound(viewWithLight({1, 0, 0}));
    const PartitionSelector selector = partitionSelector({}, {0, 1, 0}, {0.1, 1000}, FaceMaps::SidesAndNear);
    EXPECT_EQ(selector.faces.size(), 1U);
    EXPECT_FALSE(selector.ownNear);
}

void lightInAFace() {
    const ViewFrustum frustum;
    for (const double off : {0.0, 1e-13, 1e-9, 1e-5, 1e-2}) {
        const double angle = frustum.halfFovYRadians + off;
        expectSound(viewWithLight({0, std::sin(angle), std::cos(angle)}));
        expectSound(viewWithLight({0, -std::sin(angle), -std::cos(angle)}));
    }
}

void onASplitPlane() {
    const ShadowMapSetup setup = shadowMapSetup({}, {});
    for (std::size_t i = 1; i < 4; ++i) {
        const double z = setup.selector.splits[i];
        EXPECT_EQ(setup.mapOf({0, 0, z}), i);
        EXPECT_EQ(setup.mapOf({0, 0, std::nextafter(z, 0.0)}), i - 1);
    }
}

void behindTheWarp() {
    const ShadowMapSetup setup = shadowMapSetup({}, {});
    const ShadowMap& first = setup.maps[0];
    const double centre = first.warped.zMin - 1 / first.warped.kappa; // the light-space z where w = 0
    const glm::dvec3 behind = toCamera(first.warped.frame, {0, 1, centre - 0.1});
    EXPECT_LT((first.lightClipFromCamera() * glm::dvec4(behind, 1)).w, 0);
    // Undivided, the clip planes of the sides reject it; divided, it would land inside the map, mirrored.
    const glm::dvec4 clip = first.lightClipFromCamera() * glm::dvec4(behind, 1);
    EXPECT_FALSE(std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w);
}

void pastTheVanishingLine() {
    const ViewFrustum frustum{1, 1e5, 0.5, 1};
    const LightFit fit = fitSlice(lightFrame({0, 1, 0}), frustum);
    const WarpedMap map = warpedMap(fit, 1 / frustum.near);
    const Region region = partitionRegion(frustum, partitionSelector(frustum, {0, 1, 0}, {1, 1e5}, FaceMaps::None), 0);
    std::vector<glm::dvec3> corners;
    for (const FitVertex& vertex : region.vertices)
        corners.push_back(vertex.position);
    const ConvexVolume grown = grownCasterVolume(corners, map, 0.01, 0.01);
    // The lookup's gutter reads what lies at any distance beyond the far plane, so nothing may bound it there.
    EXPECT_TRUE(contains(grown, {0, 1e6, 1e9}));
}

void hugeRatio() {
    ShadowView view;
    view.frustum = {1, 1e8, 0.5, 1};
    expectSound(view);
    EXPECT_LT(floatError(view.frustum).fromTheOrigin, 0.01);
}

void tinyRatio() {
    ShadowView view;
    view.frustum = {1, 1 + 1e-6, 0.5, 1};
    expectSound(view);
    const FloatError error = floatError(view.frustum);
    EXPECT_LT(error.fromTheOrigin, 0.01);
    EXPECT_GT(error.fromTheEye, 100); // or the case is none
    EXPECT_NEAR(sliceRatioMinusOne(1, 1 + 1e-12, 4) / 0.25e-12, 1, 1e-3);
}

void tinyAngle() {
    ShadowView view;
    view.frustum = {1, 1000, 0.005 * kPi / 180, 1};
    expectSound(view);
    EXPECT_LT(floatError(view.frustum).fromTheOrigin, 0.01);
    // Where near and far lie a thousandth apart, depths from the eye are rounded to whole texels.
    view.frustum.near = 999;
    expectSound(view);
    const FloatError error = floatError(view.frustum);
    EXPECT_LT(error.fromTheOrigin, 0.01);
    EXPECT_GT(error.fromTheEye, 1); // or the case is none
}

/// What an orthographic view is planned as: an eye 256 sizes away. The limit of every warp is none.
void parallelSight() {
    for (const double degrees : {0.2, 1e-3, 1e-6}) {
        ShadowView view;
        view.frustum = {255.5, 256.5, degrees * kPi / 180, 1};
        expectSound(view);
        EXPECT_LT(floatError(view.frustum).fromTheOrigin, 0.01);
        Random random(2);
        for (int i = 0; i < 50; ++i) {
            view.towardsLight = randomLight(random);
            ShadowOptions options;
            options.scheme.warp.rule = WarpRule::None;
            const double plain = shadowMapSetup(view, options).worst().worst();
            options.scheme.warp.rule = WarpRule::Minimax;
            EXPECT_GE(shadowMapSetup(view, options).worst().worst(), plain * (1 - 2e-2));
        }
    }
}

void otherShapes() {
    for (const double aspect : {0.1, 10.0}) {
        ShadowView view;
        view.frustum.aspect = aspect;
        expectSound(view);
    }
}

void farFromTheOrigin() {
    ShadowView view;
    view.anchor.eye = {1e7, -1e7, 1e7};
    expectSound(view);
}

void nearHole() {
    // 17.8% of each slice's outline at k = 8 with the light behind: the near square over the far one, (1/q)^2.
    const double q = 1 + sliceRatioMinusOne(1, 1000, 8);
    EXPECT_NEAR(1 / (q * q), 0.178, 0.001);
    ShadowOptions options;
    options.scheme.faces = true;
    options.scheme.nearFace = NearFace::Omit;
    options.scheme.slices = 8;
    const ShadowView view = viewWithLight({0, 0, -1});
    const ShadowMapSetup setup = shadowMapSetup(view, options);
    const glm::dvec3 p(0, 0, view.frustum.near * 1.01);
    EXPECT_NE(setup.mapOf(p), ShadowMapSetup::kNoMap);
}

void literalBisector() {
    Scheme scheme;
    scheme.faces = true;
    scheme.slices = 1;
    scheme.nearFace = NearFace::Omit;
    scheme.warp.rule = WarpRule::Minimax;
    Random random(1);
    const ViewFrustum frustum{1, 1000, 20 * kPi / 180, 1};
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 light = randomDirection(random);
        scheme.bisector = Bisector::Literal;
        const double literal = storageFactor(schemeMaps(frustum, light, scheme));
        scheme.bisector = Bisector::Normalized;
        worst = std::max(worst, literal / storageFactor(schemeMaps(frustum, light, scheme)));
    }
    EXPECT_GT(worst, 10);
}

void wimmerTilted() {
    const ViewFrustum frustum{1, 1000, 45 * kPi / 180, 1};
    Random random(2);
    double worstWimmer = 0;
    double worstAuto = 0;
    for (int i = 0; i < 20000; ++i) {
        const LightFit fit = fitSlice(lightFrame(randomDirection(random)), frustum);
        const double unwarped = storageFactor(fit, 0);
        worstWimmer = std::max(worstWimmer, storageFactor(fit, kappaLspsm(fit)) / unwarped);
        worstAuto = std::max(worstAuto, storageFactor(fit, kappaAuto(fit)) / unwarped);
    }
    EXPECT_GT(worstWimmer, 25);
    EXPECT_LE(worstAuto, 1 + 1e-12);
}

void smallNearSquare() {
    // With far a million times near, an outline tolerance in units of far swallows the near square whole.
    ViewFrustum frustum{1, 1e6, 0.5, 1};
    const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, 0.4, -0.8));
    const PartitionSelector selector = partitionSelector(frustum, light, {1, 1e6}, FaceMaps::SidesAndNear);
    const Region near = partitionRegion(frustum, selector, selector.faces.size());
    EXPECT_EQ(near.face, Face::Near);
    const ConvexVolume sweep = casterVolume(near, lightFrame(light));
    EXPECT_FALSE(contains(sweep, glm::dvec3(0, 5, 1) + light * 10.0));
}

void tooFewTexels() {
    ShadowOptions options;
    options.scheme.slices = 64;
    options.texels = 1000;
    EXPECT_THROW(shadowMapSetup({}, options), Error);
}

void clampedCaster() {
    const ShadowMapSetup setup = shadowMapSetup({}, {});
    for (const ShadowMap& map : setup.maps)
        for (const FitVertex& vertex : map.region.vertices) {
            const glm::dvec3 steep = map.warped.frame.x * std::sqrt(0.99) + map.warped.frame.y * 0.1;
            const double bias = receiverBias(cameraImage(map), vertex.position, steep, 0.1);
            EXPECT_GE(mapPoint(map.warped, vertex.position).depth, bias);
        }
}

void grazingReceiver() {
    const ShadowMapSetup setup = shadowMapSetup({}, {});
    const ShadowMap& map = setup.maps[0];
    const glm::dvec3 p = map.region.vertices[0].position;
    const LightFrame& frame = map.warped.frame;
    for (const double cosine : {1e-2, 1e-6, 1e-12}) {
        const glm::dvec3 normal = glm::normalize(frame.x + frame.y * cosine);
        EXPECT_LT(receiverBias(cameraImage(map), p, normal, cosine), 1);
        EXPECT_LT(receiverBias(rounded(cameraImage(map)), glm::vec3(p), glm::vec3(normal), float(cosine)), 1);
    }
}

/// How much of (x, y) of the divided clip position changes a step `along` at p, by the quotient rule.
glm::dvec2 derivative(const glm::dmat4& clipFromCamera, const glm::dvec3& p, const glm::dvec3& along) {
    const glm::dvec4 clip = clipFromCamera * glm::dvec4(p, 1);
    const glm::dvec4 change = clipFromCamera * glm::dvec4(along, 0);
    return (glm::dvec2(change) * clip.w - glm::dvec2(clip) * change.w) / (clip.w * clip.w);
}

void steepWarp() {
    ShadowView view;
    ShadowOptions options;
    options.scheme.slices = 1;
    options.scheme.warp.rule = WarpRule::Given;
    for (const double kappa : {1e2, 1e5, 1e8})
        for (const glm::dvec3& light : {glm::dvec3(0, 1, 0), glm::dvec3(0.3, 1, 0.2), glm::dvec3(0.9, 0.1, -0.6)}) {
            view.towardsLight = glm::normalize(light);
            options.scheme.warp.kappa = kappa;
            const ShadowMapSetup setup = shadowMapSetup(view, options);
            const ShadowMap& map = setup.maps.at(0);
            const glm::dmat4 uploaded(rounded(cameraImage(map)).clipFromOffset);
            for (const FitVertex& vertex : map.region.vertices)
                for (const glm::dvec3& along : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
                    const glm::dvec2 exact = derivative(map.lightClipFromCamera(), vertex.position, along);
                    const glm::dvec2 found = derivative(uploaded, vertex.position, along);
                    EXPECT_LE(glm::length(found - exact), 1e-3 * glm::length(exact));
                }
        }
}

/// A far depth of a fifteenth and a near one of seventy times what is in view.
void shownOutsideTheGivenRange() {
    for (const glm::dvec3& light : {glm::dvec3(0, 1, 0), glm::dvec3(0.1, 0.3, -1), glm::dvec3(0, 0, 1)})
        for (const bool isStable : {false, true}) {
            ShadowView view = viewWithLight(light);
            view.frustum.near = 20;
            view.frustum.far = 60;
            view.shown = DepthSpan{0.3, 900};
            ShadowOptions options;
            options.stabilized = isStable;
            const ShadowMapSetup setup = shadowMapSetup(view, options);
            for (const double depth : {0.3, 19.9, 60.1, 900.0})
                for (const glm::dvec3& p : corners(slice(view.frustum, depth / 2, depth))) {
                    if (p.z < depth) continue;
                    const MapPoint at = mapPoint(setup.maps.at(setup.mapOf(p)).warped, p);
                    EXPECT_GT(at.w, 0);
                    for (const double coordinate : {at.s, at.t, at.depth})
                        EXPECT_NEAR(coordinate, 0.5, 0.5 + 1e-9) << "at depth " << depth;
                }
        }
}

void nearOnAStep() {
    NearState state = nextNear({}, 1, 1e-4);
    for (int i = 0; i < 100; ++i) {
        state = nextNear(state, i % 2 == 0 ? 1 - 1e-12 : 1 + 1e-12, 1e-4);
        EXPECT_NEAR(state.near, 1, 1e-9);
    }
}

constexpr std::array<HardCase, 25> kCases{{
    {"light exactly parallel to the view",
     "the cross product of light and view is 0, and its normalisation gives NaN",
     lightParallel},
    {"light 1e-15 to 1e-3 radians from the view",
     "sin gamma = sqrt(1 - dot^2) loses all digits; n' becomes infinite and kappa 0",
     lightNearlyParallel},
    {"light passing through the view direction",
     "the axis of the map, the projected view, turns by half a turn at once",
     spinningOrientation},
    {"light straight overhead or from the side",
     "the light sees the near face edge-on, and the map of this face has length 0",
     lightOverhead},
    {"light in the plane of a face",
     "two edges of the face project onto opposite directions, and its map has width 0",
     lightInAFace},
    {"a point on a split plane", "strict comparisons on both sides assign the point to no slice", onASplitPlane},
    {"a caster behind the warp's centre of projection",
     "w <= 0: after the division, the caster appears mirrored in the map",
     behindTheWarp},
    {"a map border past the vanishing line",
     "one texel beyond the far edge is beyond infinity, and the caster volume with its border turns inside out",
     pastTheVanishingLine},
    {"depth ratio 1e8",
     "a float frustum matrix that fades from perspective to orthogonal loses whole texels",
     hugeRatio},
    {"depth ratio 1 + 1e-6",
     "q - 1 from pow cancels (q: depth ratio of a slice); float positions relative to the eye are wrong by 400 texels",
     tinyRatio},
    {"half angle 0.005 degrees", "float positions relative to the eye are coarser than a texel", tinyAngle},
    {"parallel lines of sight",
     "there is no depth ratio and no angle to divide by; an eye placed far away loses whole texels",
     parallelSight},
    {"images ten times as wide as high, or as high as wide",
     "closed forms and bisectors for a square frustum are wrong",
     otherShapes},
    {"eye 1e7 units from the origin",
     "float corners of the frustum in world space are wrong by metres",
     farFromTheOrigin},
    {"near face omitted", "up to a fifth of each slice's outline has no map when the light is behind", nearHole},
    {"bisector e0' + e1' taken literally",
     "the longer edge dominates the sum, and the error grows more than tenfold",
     literalBisector},
    {"Wimmer's rule for a tilted light",
     "the storage factor is up to 31 times the factor without a warp",
     wimmerTilted},
    {"near face at a millionth of the far depth",
     "a tolerance relative to the far depth removes the near face, and its caster volume loses sides",
     smallNearSquare},
    {"a warp with kappa d above 10,000",
     "a float matrix cannot hold its derivatives, and the measured aliasing exceeds the bound",
     steepWarp},
    {"more maps than texels", "a map has sides of 0 or less", tooFewTexels},
    {"a caster clamped to depth 0 over a biased receiver",
     "the biased depth of the receiver is below 0, so the clamped caster does not darken it",
     clampedCaster},
    {"a receiver edge-on to the light", "its depth slope is infinite, and so is its bias", grazingReceiver},
    {"nearest surface exactly on a quantised step of near",
     "rounding moves the near plane back and forth between frames",
     nearOnAStep},
    {"near and far given so that surfaces lie outside",
     "lookups outside read the edge of the map: all is dark beyond far and lit before near",
     shownOutsideTheGivenRange},
    {"a light 1e-12 off the plane between two kinds of faces",
     "lit and unlit sides swap, and faces turn from front to back",
     [] {
         expectSound(viewWithLight({0, 1, 1e-12}));
         expectSound(viewWithLight({0, 1, -1e-12}));
     }},
}};

TEST(HardCases, OfTheShadowsHoldAndAreOnThePage) {
    runHardCases(GNOMON_SOURCE_DIR, "Shadows", kCases);
}

} // namespace
} // namespace gnomon::shadow
