#include "shadow/setup.h"

#include "core/check.h"
#include "core/error.h"
#include "shadow/partition/grazing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

namespace {

/// Returns the max warp strength kappa for which float matrices achieve the aliasing bound with an error of at most
/// 0.1%. The derivatives of the matrix are differences of numbers that are kappa d times larger. Only two warps exceed
/// this limit: a TSM with its focus at the near side, and a PSM of a larger depth ratio.
double maxKappaOf(const LightFit& fit) {
    // Logarithmic rows are computed relative to the vanishing line of the warp, so they lose less precision.
    const double kMaxWarp = fit.rows == RowSpacing::Logarithmic ? 1e6 : 1e4; // max kappa d
    return fit.length > 0 ? kMaxWarp / fit.length : std::numeric_limits<double>::infinity();
}

/// A shadow map before the distribution of the texel budget.
struct UnsizedMap {
    Region region;
    LightFit fit;
    double kappa = 0;
    Aliasing unit;      // max perspective aliasing M_x and M_z at unit resolutions, without a filter
    double sheared = 0; // max sheared aliasing M_t at unit resolutions, without a filter
};

double filterWidth(const ShadowOptions& options) {
    return std::max(1.0, options.filterTexels);
}

/// Returns true if the view is so thin that float positions relative to the eye cannot resolve its texels.
bool isThin(const ViewFrustum& frustum) {
    constexpr double kDegree = 0.017453292519943295;
    return frustum.depthRatio() < 1.1 || frustum.halfFovYRadians < kDegree;
}

/// Returns the slice that determines the orientation of the maps of all slices: the slice with the largest depth ratio.
/// The orientation has the largest effect on this slice. All other slices are similar to it or have smaller ratios.
ViewFrustum leadingSlice(const ViewFrustum& frustum, const std::vector<double>& splits) {
    std::size_t leading = 0;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i)
        if (splits[i + 1] / splits[i] > splits[leading + 1] / splits[leading] * (1 + 1e-9)) leading = i;
    return slice(frustum, splits[leading], splits[leading + 1]);
}

/// Returns the light-space axes for the shadow map of `region`. For a near square, the z axis follows one of the
/// square's edges, or both.
LightFrame frameOf(const Region& region, const glm::dvec3& towardsLight, const Scheme& scheme) {
    const Bisector bisector = bisectorOf(scheme);
    if (region.face == Face::Near && bisector != Bisector::NearEdge)
        return lightFrameAlong(towardsLight, glm::dvec3(0, 1, 0));
    return faceFrame(region.frustum, towardsLight, region.face, bisector);
}

UnsizedMap unsizedMap(
    const ShadowView& view, const ShadowOptions& options, Region region, const LightFrame& sliceFrame) {
    UnsizedMap unsized;
    const LightFrame frame =
        region.face == Face::Whole ? sliceFrame : frameOf(region, view.towardsLight, options.scheme);
    unsized.fit = fitRegion(frame, region.frustum, region.vertices);
    const Warp warp = warpOfSlice(options.scheme.warp, view.frustum, region.frustum);
    unsized.fit.rows = rowsOf(warp.rule);
    unsized.kappa = std::min(kappaOfMap(warp, unsized.fit, region.face), maxKappaOf(unsized.fit));
    // Logarithmic rows that are almost even are drawn as even rows. Their vanishing line is so far away that floats
    // cannot distinguish many rows.
    constexpr double kMinLogWarp = 0.05; // min kappa d
    if (unsized.fit.rows == RowSpacing::Logarithmic && unsized.kappa * unsized.fit.length < kMinLogWarp)
        unsized.kappa = 0;
    unsized.unit = worstAliasing(unsized.fit, unsized.kappa);
    unsized.sheared = worstShearedAliasing(unsized.fit, unsized.kappa);
    // If the light grazes a face of the frustum, the texels of its map are sheared, and are far longer than their
    // extent along the t axis. The sheared length therefore determines the number of texels in t.
    if (unsized.fit.rows == RowSpacing::Logarithmic) unsized.unit.z = unsized.sheared;
    unsized.region = std::move(region);
    return unsized;
}

UnsizedMap stableDraftOf(Region region, const LightFrame& frame) {
    UnsizedMap unsized;
    unsized.fit = fitRegion(frame, region.frustum, region.vertices);
    const double twoTan = 2 * tanHalfY(region.frustum);
    const double unit = stableExtent(region.covered) / (twoTan * region.frustum.near);
    unsized.unit = {unit, unit};
    unsized.sheared = unit;
    unsized.region = std::move(region);
    return unsized;
}

StablePlace placeOf(
    const ShadowView& view, const ShadowOptions& options, const UnsizedMap& unsized, int texelsS, int texelsT) {
    const int texels = std::min(texelsS, texelsT);
    const double texel = stableExtent(unsized.region.covered) / (texels - 1);
    // This depth bias is for the min cosine between normal and light, along both axes. It is valid for each orientation
    // of the map.
    const double steepest = 1 / kMinCosine + kUnevenSlope;
    const double bias = reachTexels(options.filterTexels) * 2 * steepest * texel;
    return stablePlace(view.anchor, unsized.fit.frame, unsized.region.covered, texels, bias);
}

bool isLogFace(const UnsizedMap& unsized) {
    return unsized.fit.rows == RowSpacing::Logarithmic && unsized.kappa > 0;
}

WarpedMap regionMap(const ShadowOptions& options, const UnsizedMap& unsized, int texelsS, int texelsT) {
    const Resolution texels{1, static_cast<double>(texelsS), static_cast<double>(texelsT)};
    // Rounding in a lookup can miss the correct row by `rowsMissed`. The missed rows count as a wider filter, which
    // reaches this number of rows on each side.
    const double missed =
        isLogFace(unsized) ? 2 * rowsMissed(unsized.region.frustum, unsized.region.face, unsized.fit.frame.y, texelsT)
                           : 0;
    const double width = std::max(1.0, options.filterTexels) + missed;
    const double bias = largestRawBias(unsized.fit, unsized.kappa, texels, missed > 0 ? width : options.filterTexels);
    return warpedMap(unsized.fit, unsized.kappa, bias);
}

AliasingBound aliasingBoundOf(
    const ShadowView& view,
    const ShadowOptions& options,
    const UnsizedMap& unsized,
    const WarpedMap& map,
    double s,
    double t) {
    const double pixels = view.imageHeight * filterWidth(options);
    if (options.stabilized) {
        const double twoTan = 2 * tanHalfY(unsized.region.frustum);
        const double m = map.width / s / (twoTan * unsized.region.frustum.near) * pixels;
        return {m, m, m};
    }
    return {unsized.unit.x / s * pixels, unsized.unit.z / t * pixels, unsized.sheared / t * pixels};
}

/// Returns the origin for float positions in a thin slice: the mean of the slice's vertices.
glm::dvec3 originOf(const Region& region) {
    glm::dvec3 sum(0);
    for (const FitVertex& vertex : region.vertices)
        sum += vertex.position;
    return sum / static_cast<double>(region.vertices.size());
}

std::vector<glm::dvec3> cornersOf(const Region& region) {
    std::vector<glm::dvec3> corners;
    for (const FitVertex& vertex : region.vertices)
        corners.push_back(vertex.position);
    return corners;
}

/// Returns points whose convex hull contains all receivers in the map of `region`. If there are no receivers, returns
/// the corners of the region.
std::vector<glm::dvec3> receiversOf(const ShadowView& view, const Region& region) {
    std::vector<glm::dvec3> corners = seenCorners(region, view.seen, view.anchor.basis);
    return corners.empty() ? cornersOf(region) : corners;
}

ShadowMap finished(
    const ShadowView& view,
    const ShadowOptions& options,
    UnsizedMap unsized,
    const TexelLayout& layout,
    std::size_t index) {
    ShadowMap result;
    const int texelsS = layout.texelsS(index);
    const int texelsT = layout.texelsT(index);
    result.rectangle = layout.packing.rectangles[index];
    result.gutter = layout.gutter;
    result.filterTexels = options.filterTexels;
    if (options.stabilized) {
        result.stable = placeOf(view, options, unsized, texelsS, texelsT);
        const LightFrame& frame = unsized.fit.frame;
        result.warped =
            stableMap(*result.stable, frame, toLight(frame, gnomon::toCamera(view.anchor.basis, view.anchor.eye)));
    } else {
        result.warped = regionMap(options, unsized, texelsS, texelsT);
    }
    const double reach = layout.gutter;
    // A stabilised shadow map is reused while its casters stay the same. The casters must therefore not depend on the
    // visible slabs.
    const std::vector<glm::dvec3> receivers =
        options.stabilized ? cornersOf(unsized.region) : receiversOf(view, unsized.region);
    result.casterVolume = grownCasterVolume(receivers, result.warped, reach / texelsS, reach / texelsT);
    result.aliasingBound = aliasingBoundOf(view, options, unsized, result.warped, texelsS, texelsT);
    if (isThin(view.frustum)) result.origin = originOf(unsized.region);
    result.region = std::move(unsized.region);
    return result;
}

void requireValid(const ShadowView& view, const ShadowOptions& options) {
    requireValid(view.frustum);
    const double length = glm::length(view.towardsLight);
    if (!(std::abs(length - 1) < 1e-6)) throw Error("light", "direction", "unit length", std::to_string(length));
    if (options.scheme.slices < 1 || options.scheme.slices > 64)
        throw Error("z-partitions", "number", "1 to 64", std::to_string(options.scheme.slices));
    if (view.imageHeight < 1) throw Error("image", "height in pixels", "at least 1", std::to_string(view.imageHeight));
}

} // namespace

TexelLimits limitsOf(const ShadowOptions& options) {
    const bool hasRows = rowsOf(options.scheme.warp.rule) == RowSpacing::Logarithmic && !options.stabilized;
    const int gutter = static_cast<int>(std::ceil(options.filterTexels / 2)) + 1;
    return {options.texels, gutter, options.minSide, options.maxSide, options.stabilized ? 1 : 0, !hasRows};
}

AliasingBound ShadowMapSetup::worst() const {
    AliasingBound result;
    for (const ShadowMap& map : maps) {
        result.x = std::max(result.x, map.aliasingBound.x);
        result.z = std::max(result.z, map.aliasingBound.z);
        result.sheared = std::max(result.sheared, map.aliasingBound.sheared);
    }
    return result;
}

ShadowMapSetup shadowMapSetup(
    const ShadowView& view, const ShadowOptions& options, const std::optional<OrientationState>& previous) {
    requireValid(view, options);
    const Scheme& scheme = options.scheme;
    const bool faces = scheme.faces && !options.stabilized;
    const FaceMaps withSides = scheme.nearFace == NearFace::OwnMap ? FaceMaps::SidesAndNear : FaceMaps::Sides;
    const FaceMaps faceMaps = faces ? withSides : FaceMaps::None;
    ShadowMapSetup setup;
    setup.selector = partitionSelector(
        view.frustum,
        view.towardsLight,
        practicalSplits(view.frustum.near, view.frustum.far, scheme.slices, scheme.splitLambda),
        faceMaps,
        minGrazing(view.frustum, rowsOf(scheme.warp.rule)));
    LightFrame frame = lightFrame(view.towardsLight);
    if (options.stabilized)
        frame = stableFrame(view.anchor, view.towardsLight);
    else if (options.chosenOrientation && !faces) {
        const ViewFrustum leading = leadingSlice(view.frustum, setup.selector.splits);
        frame = chosenFrame(leading, view.towardsLight, warpOfSlice(scheme.warp, view.frustum, leading), previous);
    }
    setup.orientation = {view.towardsLight, frame.z};
    std::vector<UnsizedMap> unsizedMaps;
    setup.mapOfPartition.assign(setup.selector.partitionCount(), ShadowMapSetup::kNoMap);
    for (std::size_t i = 0; i < setup.selector.partitionCount(); ++i) {
        const std::size_t sliceIndex = i / setup.selector.facesPerSlice();
        if ((options.emptySlices >> sliceIndex & 1U) != 0) continue;
        setup.mapOfPartition[i] = unsizedMaps.size();
        Region region = partitionRegion(view.frustum, setup.selector, i, view.shown);
        unsizedMaps.push_back(
            options.stabilized ? stableDraftOf(std::move(region), frame)
                               : unsizedMap(view, options, std::move(region), frame));
    }
    if (unsizedMaps.empty()) return setup;
    const double pixels = view.imageHeight * filterWidth(options);
    for (const UnsizedMap& unsized : unsizedMaps)
        setup.demands.push_back({unsized.unit.x * pixels, unsized.unit.z * pixels});
    const TexelLayout layout = splitTexels(setup.demands, limitsOf(options));
    setup.textureWidth = layout.packing.width;
    setup.textureHeight = layout.packing.height;
    for (std::size_t i = 0; i < unsizedMaps.size(); ++i)
        setup.maps.push_back(finished(view, options, std::move(unsizedMaps[i]), layout, i));
    return setup;
}

std::uint64_t requiredTexels(const ShadowMapSetup& setup, const ShadowOptions& options, double aliasing) {
    if (setup.demands.empty()) return 0;
    return requiredTexels(setup.demands, aliasing, limitsOf(options));
}

} // namespace gnomon::shadow
