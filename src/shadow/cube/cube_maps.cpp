#include "shadow/cube/cube_maps.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

/// The min and max of dot(axis, p) over a box.
struct Interval {
    double min = 0;
    double max = 0;
};

Interval along(const glm::dvec3& axis, const Box& box) {
    const double middle = glm::dot(axis, box.center());
    const double reach = glm::dot(glm::abs(axis), box.extent() * 0.5);
    return {middle - reach, middle + reach};
}

double minSize(const Interval& values) {
    return std::max({values.min, -values.max, 0.0});
}

/// Returns the range of the quotients of `values` and distances from `near` to `far`. The range is clamped to [-1, 1],
/// the tangents at the edges of a cube face. If `near` is 0, the quotient has no bound.
Interval tangents(const Interval& values, double near, double far) {
    const auto quotient = [&](double value, double nearer, double farther) {
        const double over = value < 0 ? nearer : farther;
        return over > 0 ? std::clamp(value / over, -1.0, 1.0) : (value < 0 ? -1.0 : 1.0);
    };
    return {quotient(values.min, near, far), quotient(values.max, far, near)};
}

/// The extents of the receivers that one cube face sees from the light.
struct FaceReceivers {
    Interval s{2, -2}; // tangents along s
    Interval t{2, -2};
    Interval w{std::numeric_limits<double>::infinity(), 0}; // distances along the axis of the face
    // max of w / view depth, for receivers whose view depth is in [near, far]
    double ratio = 0;
    double maxDepthRatio = 0; // max of w / view depth, for receivers outside [near, far]

    bool isAny() const { return w.max > 0; }
};

/// Returns the bounding box of the part of the view between two depths, in world axes relative to the eye.
Box slabBox(const LampView& view, const DepthSpan& depths) {
    Box box;
    for (const glm::dvec3& corner : corners(slice(view.frustum, depths.near, depths.far)))
        box.add(toWorld(view.basis, corner));
    return box;
}

Box common(const Box& a, const Box& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

/// Returns the boxes (slabs) of the visible surfaces. If they are not known, returns slabs that cover the whole view.
std::vector<VisibleSlab> visibleSlabs(const LampView& view) {
    std::vector<VisibleSlab> parts;
    for (VisibleSlab part : view.seen) {
        part.depths.near = std::max(part.depths.near, view.shown.near);
        part.depths.far = std::max(part.depths.far, part.depths.near * (1 + 1e-9));
        constexpr double kSlack = 1e-9; // prevents empty slabs for a flat ground
        const glm::dvec3 slack(kSlack * part.depths.far);
        const Box box = common({part.box.min - slack, part.box.max + slack}, slabBox(view, part.depths));
        if (!box.isEmpty()) parts.push_back({part.depths, box});
    }
    if (!view.seen.empty()) return parts;
    constexpr double kStep = 1.0442737824274138; // depth ratio of a slab: 2^(1/16)
    for (double near = view.shown.near; near < view.shown.far; near *= kStep) {
        const DepthSpan depths{near, std::min(near * kStep, view.shown.far)};
        parts.push_back({depths, slabBox(view, depths)});
    }
    return parts;
}

void addPart(
    const LampView& view,
    const LightFrame& axes,
    const glm::dvec3& light,
    const VisibleSlab& part,
    FaceReceivers& face) {
    const Box box{part.box.min - light, part.box.max - light};
    const Interval x = along(axes.x, box);
    const Interval z = along(axes.z, box);
    Interval w = along(-axes.y, box);
    // Extends each face slightly, so that a point that rounding may assign to either of two faces has a map in both.
    constexpr double kSeam = 1 - 1e-6;
    w.min = std::max({w.min, minSize(x) * kSeam, minSize(z) * kSeam});
    if (!(w.max > 0) || w.min > w.max) return;
    const Interval s = tangents(x, w.min, w.max);
    const Interval t = tangents(z, w.min, w.max);
    face.s = {std::min(face.s.min, s.min), std::max(face.s.max, s.max)};
    face.t = {std::min(face.t.min, t.min), std::max(face.t.max, t.max)};
    face.w = {std::min(face.w.min, w.min), std::max(face.w.max, w.max)};
    face.maxDepthRatio = std::max(face.maxDepthRatio, w.max / part.depths.near);
    if (part.depths.far >= view.frustum.near && part.depths.near <= view.frustum.far)
        face.ratio = std::max(face.ratio, w.max / std::max(part.depths.near, view.frustum.near));
}

/// A cube face with receivers, before it receives texels.
struct FaceDraft {
    std::size_t index = 0;
    FaceReceivers receivers;
    TexelDemand demand;
};

FaceDraft unsizedMap(const LampView& view, double kernel, std::size_t index, FaceReceivers receivers) {
    constexpr double kMinTangent = 1e-6; // min size of a map, as a tangent
    for (Interval* range : {&receivers.s, &receivers.t}) {
        const double missing = std::max(kMinTangent - (range->max - range->min), 0.0);
        range->min -= missing / 2;
        range->max += missing / 2;
    }
    // A face also receives texels if all its receivers are outside the depth range with an aliasing bound.
    const double ratio = receivers.ratio > 0 ? receivers.ratio : receivers.maxDepthRatio;
    const double pixels = view.imageHeight / (2 * tanHalfY(view.frustum)) * kernel * ratio;
    return {
        index, receivers, {(receivers.s.max - receivers.s.min) * pixels, (receivers.t.max - receivers.t.min) * pixels}};
}

/// Returns the four side planes of the pyramid from the light through `face`, in camera space. Each side is moved
/// outwards by `growS` or `growT`, which are tangents.
ConvexVolume pyramid(const CubeFaceProjection& face, double growS, double growT) {
    ConvexVolume volume;
    const auto add = [&](const glm::dvec3& normal) {
        const glm::dvec3 unit = glm::normalize(normal);
        volume.planes.push_back({unit, -glm::dot(unit, face.light)});
    };
    const glm::dvec3 outward = -face.frame.y;
    add(face.frame.x - outward * (face.sMin - growS));
    add(outward * (face.sMin + face.sRange + growS) - face.frame.x);
    add(face.frame.z - outward * (face.tMin - growT));
    add(outward * (face.tMin + face.tRange + growT) - face.frame.z);
    volume.planes.push_back({-outward, glm::dot(outward, face.light) + face.far});
    return volume;
}

/// Returns the region of space that the face sees between the depths of its receivers.
Region regionOf(const LampView& view, const CubeFaceProjection& face, std::size_t index) {
    Region region;
    region.face = kCubeFaces[index];
    region.frustum = view.frustum;
    region.covered = slice(view.frustum, view.shown.near, view.shown.far);
    region.volume = pyramid(face, 0, 0);
    region.volume.planes.push_back({{0, 0, 1}, -view.shown.near});
    region.volume.planes.push_back({{0, 0, -1}, view.shown.far});
    return region;
}

/// Sets the near and far end of the depth range of a cube face's map. The range begins so near to the light that the
/// depth bias never moves a receiver before the range. The ratio far / near is limited, because floats could not
/// distinguish depths otherwise. Surfaces nearer to the light than `near` are lit.
void setDepths(CubeFaceProjection& face, const Interval& w, double texelS, double texelT, double filterTexels) {
    constexpr double kMaxRatio = 1000;
    const double steepest = (texelS + texelT) / kMinCosine + kUnevenSlope * std::hypot(texelS, texelT);
    face.far = w.max * (1 + 1e-6);
    face.near = std::max(w.min / (1 + reachTexels(filterTexels) * steepest), face.far / kMaxRatio);
    face.near = std::min(face.near, face.far * (1 - 1e-6));
}

ShadowMap finished(
    const LampView& view,
    const ShadowOptions& options,
    const FaceDraft& unsized,
    const TexelLayout& layout,
    std::size_t i) {
    ShadowMap map;
    map.rectangle = layout.packing.rectangles[i];
    map.gutter = layout.gutter;
    map.filterTexels = options.filterTexels;
    CubeFaceProjection face;
    face.light = view.light;
    const LightFrame axes = cubeFaceAxes(unsized.index);
    face.frame = {
        gnomon::toCamera(view.basis, axes.x),
        gnomon::toCamera(view.basis, axes.y),
        gnomon::toCamera(view.basis, axes.z)};
    const FaceReceivers& receivers = unsized.receivers;
    face.sMin = receivers.s.min;
    face.sRange = receivers.s.max - receivers.s.min;
    face.tMin = receivers.t.min;
    face.tRange = receivers.t.max - receivers.t.min;
    const double texelS = face.sRange / layout.texelsS(i);
    const double texelT = face.tRange / layout.texelsT(i);
    setDepths(face, receivers.w, texelS, texelT, options.filterTexels);
    map.casterVolume = pyramid(face, layout.gutter * texelS, layout.gutter * texelT);
    map.warped.frame = face.frame;
    map.origin = view.light;
    map.region = regionOf(view, face, unsized.index);
    if (receivers.ratio > 0) {
        map.aliasingBound.x = unsized.demand.s / layout.texelsS(i);
        map.aliasingBound.z = map.aliasingBound.sheared = unsized.demand.t / layout.texelsT(i);
    }
    map.cubeFace = face;
    return map;
}

} // namespace

ShadowMapSetup cubeMapSetup(const LampView& view, const ShadowOptions& options) {
    requireValid(view.frustum);
    ShadowMapSetup setup;
    setup.selector.splits = {view.frustum.near, view.frustum.far};
    setup.mapOfPartition.assign(kCubeFaces.size(), ShadowMapSetup::kNoMap);
    const std::vector<VisibleSlab> parts = visibleSlabs(view);
    const glm::dvec3 light = gnomon::toWorld(view.basis, view.light);
    std::vector<FaceDraft> unsizedMaps;
    for (std::size_t index = 0; index < kCubeFaces.size(); ++index) {
        FaceReceivers receivers;
        for (const VisibleSlab& part : parts)
            addPart(view, cubeFaceAxes(index), light, part, receivers);
        if (!receivers.isAny()) continue;
        setup.mapOfPartition[index] = unsizedMaps.size();
        unsizedMaps.push_back(unsizedMap(view, std::max(1.0, options.filterTexels), index, receivers));
        setup.demands.push_back(unsizedMaps.back().demand);
    }
    if (unsizedMaps.empty()) return setup;
    const TexelLayout layout = splitTexels(setup.demands, limitsOf(options));
    setup.textureWidth = layout.packing.width;
    setup.textureHeight = layout.packing.height;
    for (std::size_t i = 0; i < unsizedMaps.size(); ++i)
        setup.maps.push_back(finished(view, options, unsizedMaps[i], layout, i));
    return setup;
}

} // namespace gnomon::shadow
