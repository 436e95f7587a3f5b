#include "viewer/panel/wire_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::viewer {

namespace {

constexpr double kParallel = 1e-9;

/// Returns the edge of a convex volume between its planes `a` and `b`: the part of their intersection line that is
/// inside all `planes`. Returns nullopt if the planes are parallel, if no part is inside, or if the part is infinite.
std::optional<Segment> edge(std::span<const Plane> planes, std::size_t a, std::size_t b) {
    const glm::dvec3 direction = glm::cross(planes[a].normal, planes[b].normal);
    const double sine2 = glm::dot(direction, direction);
    if (!(sine2 > kParallel * kParallel)) return std::nullopt;
    const glm::dvec3 point = (glm::cross(direction, planes[b].normal) * planes[a].offset -
                              glm::cross(direction, planes[a].normal) * planes[b].offset) /
                             sine2;
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
    const double slack = kParallel * (1 + glm::length(point)); // tolerance for other planes through this edge
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (i == a || i == b) continue;
        const double slope = glm::dot(planes[i].normal, direction);
        const double distance = planes[i].signedDistance(point);
        if (std::abs(slope) <= kParallel * std::sqrt(sine2)) {
            if (distance < -slack) return std::nullopt;
        } else if (slope > 0) {
            from = std::max(from, -distance / slope);
        } else {
            to = std::min(to, -distance / slope);
        }
    }
    if (!(from < to) || std::isinf(from) || std::isinf(to)) return std::nullopt;
    return Segment{point + direction * from, point + direction * to};
}

} // namespace

ConvexVolume volumeOf(const Box& box) {
    ConvexVolume volume;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0);
        normal[axis] = 1;
        volume.planes.push_back({normal, -box.min[axis]});
        volume.planes.push_back({-normal, box.max[axis]});
    }
    return volume;
}

std::vector<Segment> edges(const ConvexVolume& volume, const ConvexVolume& limit) {
    std::vector<Plane> planes = volume.planes;
    planes.insert(planes.end(), limit.planes.begin(), limit.planes.end());
    std::vector<Segment> result;
    for (std::size_t a = 0; a < planes.size(); ++a)
        for (std::size_t b = a + 1; b < planes.size(); ++b)
            if (const auto found = edge(planes, a, b)) result.push_back(*found);
    return result;
}

ConvexVolume inWorld(const ConvexVolume& volume, const Camera& camera) {
    const CameraBasis basis = cameraBasis(camera);
    ConvexVolume result;
    for (const Plane& plane : volume.planes) {
        const glm::dvec3 normal = toWorld(basis, plane.normal);
        result.planes.push_back({normal, plane.offset - glm::dot(normal, camera.eye)});
    }
    return result;
}

std::vector<PlanVolume> planVolumes(const plan::FramePlan& plan, const Box& bounds) {
    const Camera& camera = plan.view.camera;
    Box limit = bounds;
    if (!camera.isParallel()) limit.add(camera.eye);
    const glm::dvec3 margin = limit.extent() * 0.02;
    const ConvexVolume within = volumeOf({limit.min - margin, limit.max + margin});
    std::vector<PlanVolume> result;
    const auto add = [&](PlanVolume::Kind kind, std::size_t index, const ConvexVolume& inCamera) {
        result.push_back({kind, index, edges(inWorld(inCamera, camera), within)});
    };
    const glm::dvec3 x = glm::normalize(glm::dvec3(-1, 0, plan.view.tanHalfX()));
    const glm::dvec3 y = glm::normalize(glm::dvec3(0, -1, plan.view.tanHalfY()));
    const auto mirrored = [](const glm::dvec3& v) { return glm::dvec3(-v.x, -v.y, v.z); };
    add(PlanVolume::Kind::View,
        0,
        {{{x, 0}, {mirrored(x), 0}, {y, 0}, {mirrored(y), 0}, {{0, 0, 1}, -plan.near}, {{0, 0, -1}, plan.far}}});
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        add(PlanVolume::Kind::Partition, i, plan.passes[i].map.region.volume);
        add(PlanVolume::Kind::Casters, i, plan.passes[i].map.casterVolume);
    }
    return result;
}

std::vector<PixelSegment> onPicture(std::span<const Segment> segments, const PictureFrame& frame) {
    const CameraBasis basis = cameraBasis(frame.camera);
    const bool isParallel = frame.camera.isParallel();
    const double half = isParallel ? halfHeightAtTarget(frame.camera) : std::tan(frame.camera.fovYRadians / 2);
    const double pixels = frame.height / (2 * half);
    const double nearest = 1e-6 * glm::length(frame.camera.target - frame.camera.eye);
    const auto pixel = [&](const glm::dvec3& p) {
        const double scale = isParallel ? pixels : pixels / p.z;
        return glm::dvec2(frame.width * 0.5 + scale * p.x, frame.height * 0.5 - scale * p.y);
    };
    std::vector<PixelSegment> result;
    for (const Segment& segment : segments) {
        glm::dvec3 a = toCamera(basis, segment[0] - frame.camera.eye);
        glm::dvec3 b = toCamera(basis, segment[1] - frame.camera.eye);
        if (isParallel) {
            result.push_back({pixel(a), pixel(b)});
            continue;
        }
        if (a.z < nearest && b.z < nearest) continue;
        if (a.z < nearest) a = glm::mix(a, b, (nearest - a.z) / (b.z - a.z));
        if (b.z < nearest) b = glm::mix(b, a, (nearest - b.z) / (a.z - b.z));
        a.z = std::max(a.z, nearest);
        b.z = std::max(b.z, nearest);
        result.push_back({pixel(a), pixel(b)});
    }
    return result;
}

} // namespace gnomon::viewer
