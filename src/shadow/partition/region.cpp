#include "shadow/partition/region.h"

#include "core/check.h"
#include "shadow/partition/splits.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr double kRounding = 1e-9;

/// A side face of the frustum in cyclic order, with the signs of the corner that it shares with the next side face.
struct Side {
    Face face;
    double cornerX;
    double cornerY;
};

constexpr std::array<Side, 4> kCycle{
    {{Face::Top, 1, 1}, {Face::Right, 1, -1}, {Face::Bottom, -1, -1}, {Face::Left, -1, 1}}};

glm::dvec3 cornerRay(const ViewFrustum& frustum, const Side& side) {
    return {side.cornerX * tanHalfX(frustum), side.cornerY * tanHalfY(frustum), 1};
}

/// Returns the ray from the eye through the middle of a side face at depth 1.
glm::dvec3 middleRay(const ViewFrustum& frustum, Face face) {
    const glm::dvec3 normal = outwardNormal(frustum, face);
    const double x = normal.x == 0 ? 0 : std::copysign(tanHalfX(frustum), normal.x);
    const double y = normal.y == 0 ? 0 : std::copysign(tanHalfY(frustum), normal.y);
    return {x, y, 1};
}

/// Returns the normal of the plane through the eye that contains the ray `ray` and the light direction. `inside` is on
/// the positive side of the plane.
glm::dvec3 separator(const glm::dvec3& ray, const glm::dvec3& towardsLight, const glm::dvec3& inside) {
    const glm::dvec3 normal = glm::normalize(glm::cross(ray, towardsLight));
    return glm::dot(normal, inside) >= 0 ? normal : -normal;
}

void addNearEdge(FaceSelector& selector, const ViewFrustum& frustum, const glm::dvec3& towardsLight) {
    const bool horizontal = selector.face == Face::Top || selector.face == Face::Bottom;
    const glm::dvec3 along = horizontal ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 middle = middleRay(frustum, selector.face);
    glm::dvec3 normal = glm::normalize(glm::cross(along, towardsLight));
    // The face is behind its near edge. The normal must therefore point along the ray through the middle of the face.
    if (glm::dot(normal, middle) < 0) normal = -normal;
    selector.edge = normal;
    selector.edgeOffset = glm::dot(normal, middle);
}

/// A convex polygon in the image plane (x/z, y/z, 1).
using Outline = std::vector<glm::dvec3>;

Outline imageOutline(const ViewFrustum& frustum) {
    Outline outline;
    for (const Side& side : kCycle)
        outline.push_back(cornerRay(frustum, side));
    return outline;
}

/// Returns the part of the polygon `outline` with dot(normal, ray) >= 0. If `normal` is zero, returns the whole
/// polygon.
Outline clipped(const Outline& outline, const glm::dvec3& normal) {
    // Each corner is tested only once. With two tests, rounding could put a corner on the plane inside one of its edges
    // and outside the other, and the corner would be lost.
    std::vector<double> at;
    for (const glm::dvec3& ray : outline)
        at.push_back(glm::dot(normal, ray));
    Outline result;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        const glm::dvec3& a = outline[i];
        const glm::dvec3& b = outline[next];
        const double atA = at[i];
        const double atB = at[next];
        if (atA >= 0) result.push_back(a);
        if ((atA > 0 && atB < 0) || (atA < 0 && atB > 0)) {
            const double fraction = atA / (atA - atB);
            result.push_back(a + (b - a) * fraction);
        }
    }
    return result;
}

/// Returns the vertices of the part of the slice `part` that is in the image polygon `outline` and satisfies side *
/// (dot(edge, p) - offset) >= 0. If `edge` is zero, this condition is not tested.
std::vector<FitVertex> sliceVertices(
    const ViewFrustum& part, const Outline& outline, const glm::dvec3& edge, double offset, double side) {
    std::vector<FitVertex> result;
    const auto value = [&](const glm::dvec3& p) { return side * (glm::dot(edge, p) - offset); };
    // Rounding must not drop corners that are on the cutting plane by construction.
    const double slack = 1e-12 * part.far;
    const auto keep = [&](const glm::dvec3& p, DepthEnd end) {
        if (value(p) >= -slack) result.push_back({p, end});
    };
    const auto cross = [&](const glm::dvec3& a, const glm::dvec3& b, DepthEnd end) {
        const double atA = value(a);
        const double atB = value(b);
        const bool crosses = (atA > slack && atB < -slack) || (atA < -slack && atB > slack);
        if (crosses) result.push_back({a + (b - a) * (atA / (atA - atB)), end});
    };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec3& ray = outline[i];
        const glm::dvec3& next = outline[(i + 1) % outline.size()];
        keep(ray * part.near, DepthEnd::Near);
        keep(ray * part.far, DepthEnd::Far);
        cross(ray * part.near, next * part.near, DepthEnd::Near);
        cross(ray * part.far, next * part.far, DepthEnd::Far);
        cross(ray * part.near, ray * part.far, DepthEnd::Between);
    }
    return result;
}

/// Returns the part of the image in which partitionIndex selects `face`, as a polygon.
Outline faceOutline(const ViewFrustum& frustum, const FaceSelector& face) {
    return clipped(clipped(imageOutline(frustum), face.first), face.second);
}

void addPlane(ConvexVolume& volume, const glm::dvec3& normal, double offset) {
    if (normal != glm::dvec3(0)) volume.planes.push_back({normal, offset});
}

void addSlicePlanes(Region& region) {
    addPlane(region.volume, {0, 0, 1}, -region.covered.near);
    addPlane(region.volume, {0, 0, -1}, region.covered.far);
    for (const Side& side : kCycle)
        addPlane(region.volume, -outwardNormal(region.frustum, side.face), 0);
}

/// Returns the vertices of the near square's partition between the depths of `part`. This partition belongs to no side
/// face. `nearDepth` is the near depth of the slice.
std::vector<FitVertex> nearVertices(const ViewFrustum& part, double nearDepth, const PartitionSelector& all) {
    std::vector<FitVertex> result;
    for (const FaceSelector& face : all.faces) {
        const Outline outline = faceOutline(part, face);
        for (const FitVertex& vertex : sliceVertices(part, outline, face.edge, face.edgeOffset * nearDepth, -1)) {
            const bool known = std::any_of(result.begin(), result.end(), [&](const FitVertex& other) {
                return glm::length(other.position - vertex.position) <= 1e-13 * part.far;
            });
            if (!known) result.push_back(vertex);
        }
    }
    return result;
}

/// Returns the vertices of partition `ordinal` of a slice, between the depths of `part`. The slice begins at
/// `nearDepth`.
std::vector<FitVertex> partitionVertices(
    const ViewFrustum& part, double nearDepth, const PartitionSelector& selector, std::size_t ordinal) {
    if (selector.faces.empty()) return sliceVertices(part, imageOutline(part), glm::dvec3(0), 0, 1);
    if (ordinal == selector.faces.size()) return nearVertices(part, nearDepth, selector);
    const FaceSelector& face = selector.faces[ordinal];
    return sliceVertices(part, faceOutline(part, face), face.edge, face.edgeOffset * nearDepth, 1);
}

/// Returns the slice `slice`. If it is the first or the last of `count` slices, extends it to the view depths `shown`
/// of all receivers.
ViewFrustum coveredBy(ViewFrustum slice, std::size_t index, std::size_t count, const DepthSpan& shown) {
    if (index == 0) slice.near = std::min(slice.near, shown.near);
    if (index + 1 == count) slice.far = std::max(slice.far, shown.far);
    return slice;
}

/// Removes the planes of `region` that touch no vertex, because they do not bound the region.
void dropIdlePlanes(Region& region) {
    std::erase_if(region.volume.planes, [&](const Plane& plane) {
        return std::none_of(region.vertices.begin(), region.vertices.end(), [&](const FitVertex& vertex) {
            return plane.signedDistance(vertex.position) <= 1e-9 * region.covered.far;
        });
    });
}

/// Returns the corners of `box` in camera space. Bit i of the index selects the max of axis i.
std::array<glm::dvec3, 8> cornersOf(const Box& box, const CameraBasis& basis) {
    std::array<glm::dvec3, 8> corners{};
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(
            (i & 1U) != 0 ? box.max.x : box.min.x,
            (i & 2U) != 0 ? box.max.y : box.min.y,
            (i & 4U) != 0 ? box.max.z : box.min.z);
        corners[i] = toCamera(basis, corner);
    }
    return corners;
}

ConvexVolume volumeOf(const Box& box, const CameraBasis& basis) {
    ConvexVolume volume;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0);
        normal[axis] = 1;
        const glm::dvec3 inCamera = toCamera(basis, normal);
        volume.planes.push_back({inCamera, -box.min[axis]});
        volume.planes.push_back({-inCamera, box.max[axis]});
    }
    return volume;
}

/// Adds the two end points of the part of segment a-b that is inside `volume`. The planes of the volume are moved
/// outwards by `slack`.
void addClipped(
    const glm::dvec3& a,
    const glm::dvec3& b,
    const ConvexVolume& volume,
    double slack,
    std::vector<glm::dvec3>& points) {
    double first = 0;
    double last = 1;
    for (const Plane& plane : volume.planes) {
        const double atA = plane.signedDistance(a) + slack;
        const double atB = plane.signedDistance(b) + slack;
        if (atA < 0 && atB < 0) return;
        if (atA < 0) first = std::max(first, atA / (atA - atB));
        if (atB < 0) last = std::min(last, atA / (atA - atB));
    }
    if (first > last) return;
    points.push_back(a + (b - a) * first);
    points.push_back(a + (b - a) * last);
}

/// A convex part of a region: its planes, and line segments inside it that include all its edges.
struct Part {
    ConvexVolume volume;
    std::vector<std::array<glm::dvec3, 2>> segments;
};

/// Returns the whole `region`, with segments between all pairs of its vertices. For the region of a face, it is not
/// known which of these segments are edges.
Part wholePart(const Region& region) {
    Part part{region.volume, {}};
    for (std::size_t i = 0; i < region.vertices.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            part.segments.push_back({region.vertices[i].position, region.vertices[j].position});
    return part;
}

/// Returns the part of `region` between the depths `depths`. For the region of a face, returns the whole region.
Part partAt(const Region& region, const DepthSpan& depths) {
    if (region.face != Face::Whole) return wholePart(region);
    const double near = std::max(depths.near * (1 - kRounding), region.covered.near);
    const double far = std::min(depths.far * (1 + kRounding), region.covered.far);
    Part part{region.volume, {}};
    addPlane(part.volume, {0, 0, 1}, -near);
    addPlane(part.volume, {0, 0, -1}, far);
    for (std::size_t i = 0; i < kCycle.size(); ++i) {
        const glm::dvec3 ray = cornerRay(region.frustum, kCycle[i]);
        const glm::dvec3 next = cornerRay(region.frustum, kCycle[(i + 1) % kCycle.size()]);
        part.segments.push_back({ray * near, ray * far});
        part.segments.push_back({ray * near, next * near});
        part.segments.push_back({ray * far, next * far});
    }
    return part;
}

/// Returns the boxes (slabs) of visible surfaces at the depths of `region`, merged to at most kMaxParts slabs. More
/// slabs would make the outline of a long region only slightly tighter.
std::vector<VisibleSlab> fewParts(const Region& region, std::span<const VisibleSlab> seen) {
    constexpr std::size_t kMaxParts = 4;
    std::vector<VisibleSlab> inRegion;
    for (const VisibleSlab& part : seen)
        if (part.depths.near <= region.covered.far && part.depths.far >= region.covered.near) inRegion.push_back(part);
    if (inRegion.size() <= kMaxParts) return inRegion;
    std::vector<VisibleSlab> result(kMaxParts);
    for (std::size_t i = 0; i < inRegion.size(); ++i) {
        VisibleSlab& all = result[i * kMaxParts / inRegion.size()];
        const DepthSpan& depths = inRegion[i].depths;
        if (all.box.isEmpty()) all.depths = depths;
        all.depths = {std::min(all.depths.near, depths.near), std::max(all.depths.far, depths.far)};
        all.box.add(inRegion[i].box);
    }
    return result;
}

/// Adds points to `points` whose convex hull contains the intersection of `box` and `part`, which are both convex.
void addShared(
    const Part& part, const Box& box, const CameraBasis& basis, double slack, std::vector<glm::dvec3>& points) {
    const std::array<glm::dvec3, 8> corners = cornersOf(box, basis);
    // Each corner of the intersection of two convex bodies is on an edge of one body, inside the other body. The
    // segments can add more points, but these are also inside both bodies.
    const ConvexVolume boxVolume = volumeOf(box, basis);
    for (const auto& [first, last] : part.segments)
        addClipped(first, last, boxVolume, slack, points);
    for (unsigned i = 0; i < 8; ++i)
        for (const unsigned axis : {1U, 2U, 4U})
            if ((i & axis) == 0) addClipped(corners[i], corners[i | axis], part.volume, slack, points);
}

} // namespace

PartitionSelector partitionSelector(
    const ViewFrustum& frustum,
    const glm::dvec3& towardsLight,
    std::vector<double> splits,
    FaceMaps faceMaps,
    double grazing) {
    PartitionSelector selector;
    selector.splits = std::move(splits);
    if (faceMaps == FaceMaps::None) return selector;
    const std::vector<Face> counting = sideFaces(frustum, towardsLight, grazing);
    const auto counts = [&](std::size_t i) {
        return std::find(counting.begin(), counting.end(), kCycle[i % 4].face) != counting.end();
    };
    // The list of faces starts after a face without a map, so that adjacent faces in the list are adjacent in the
    // image.
    std::size_t start = 0;
    for (std::size_t i = 0; i < 4; ++i)
        if (!counts(i)) start = i + 1;
    selector.ownNear = faceMaps == FaceMaps::SidesAndNear && std::abs(towardsLight.z) > kGrazing && !counting.empty();
    for (std::size_t i = start; i < start + 4; ++i) {
        if (!counts(i)) continue;
        FaceSelector face;
        face.face = kCycle[i % 4].face;
        const glm::dvec3 middle = middleRay(frustum, face.face);
        // The plane between two neighbouring faces is computed once. It is the second plane of one face, and its
        // negative is the first plane of the other face.
        if (counts(i + 3))
            face.first = selector.faces.empty()
                             ? separator(cornerRay(frustum, kCycle[(i + 3) % 4]), towardsLight, middle)
                             : -selector.faces.back().second;
        if (counts(i + 1))
            face.second = i == start + 3 ? -selector.faces.front().first
                                         : separator(cornerRay(frustum, kCycle[i % 4]), towardsLight, middle);
        if (selector.ownNear) addNearEdge(face, frustum, towardsLight);
        selector.faces.push_back(face);
    }
    return selector;
}

std::size_t partitionIndex(const PartitionSelector& selector, const glm::dvec3& p) {
    const std::size_t slice = sliceOf(selector.splits, p.z);
    const std::size_t first = slice * selector.facesPerSlice();
    if (selector.faces.empty()) return first;
    std::size_t face = 0;
    double inside = glm::dot(selector.faces.front().first, p);
    while (face + 1 < selector.faces.size()) {
        const double insideSecond = glm::dot(selector.faces[face].second, p);
        if (inside >= 0 && insideSecond >= 0) break;
        inside = -insideSecond; // both neighbours use the same value, so rounding cannot exclude a point from both
        ++face;
    }
    const FaceSelector& owner = selector.faces[face];
    const bool inNear = selector.ownNear && glm::dot(owner.edge, p) < owner.edgeOffset * selector.splits[slice];
    return first + (inNear ? selector.faces.size() : face);
}

Region partitionRegion(
    const ViewFrustum& frustum,
    const PartitionSelector& selector,
    std::size_t index,
    const std::optional<DepthSpan>& shown) {
    GNOMON_CHECK_OP(index, <, selector.partitionCount());
    Region region;
    region.slice = index / selector.facesPerSlice();
    region.frustum = slice(frustum, selector.splits[region.slice], selector.splits[region.slice + 1]);
    region.covered = coveredBy(
        region.frustum,
        region.slice,
        selector.splits.size() - 1,
        shown.value_or(DepthSpan{region.frustum.near, region.frustum.far}));
    addSlicePlanes(region);
    const std::size_t ordinal = index % selector.facesPerSlice();
    const double nearDepth = region.frustum.near;
    region.vertices = partitionVertices(region.frustum, nearDepth, selector, ordinal);
    if (region.covered != region.frustum)
        for (const FitVertex& vertex : partitionVertices(region.covered, nearDepth, selector, ordinal))
            region.vertices.push_back({vertex.position, DepthEnd::WithoutBound});
    if (selector.faces.empty()) return region;
    if (ordinal == selector.faces.size()) {
        region.face = Face::Near;
        for (const FaceSelector& face : selector.faces)
            addPlane(region.volume, -face.edge, face.edgeOffset * nearDepth);
    } else {
        const FaceSelector& face = selector.faces[ordinal];
        region.face = face.face;
        addPlane(region.volume, face.first, 0);
        addPlane(region.volume, face.second, 0);
        addPlane(region.volume, face.edge, -face.edgeOffset * nearDepth);
    }
    dropIdlePlanes(region);
    return region;
}

std::vector<glm::dvec3> seenCorners(const Region& region, std::span<const VisibleSlab> seen, const CameraBasis& basis) {
    std::vector<glm::dvec3> result;
    for (const VisibleSlab& part : fewParts(region, seen)) {
        // The ground can be a flat box, and rounding must not exclude it.
        const double slack = kRounding * (region.covered.far + glm::length(part.box.extent()));
        addShared(partAt(region, part.depths), part.box, basis, slack, result);
    }
    return result;
}

} // namespace gnomon::shadow
