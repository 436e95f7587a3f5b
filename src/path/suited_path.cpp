#include "path/suited_path.h"

#include "core/error.h"
#include "core/random.h"
#include "hierarchy/cut_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::path {

namespace {

constexpr double kDuration = 12; // seconds
constexpr double kFovYRadians = 1.0471975511965976;
constexpr double kTwoPi = 6.283185307179586;
constexpr int kCells = 512; // of the walk's map, along each side

Keyframe keyframe(double time, const glm::dvec3& eye, const glm::dvec3& target) {
    return {time, {eye, target, {0, 1, 0}, kFovYRadians}};
}

/// A circle around the model, a little from above.
CameraPath orbit(const Box& bounds) {
    CameraPath path;
    path.loop = true;
    path.interpolation = Interpolation::CatmullRom;
    const glm::dvec3 center = bounds.center();
    const double radius = 0.95 * glm::length(bounds.extent());
    constexpr int kKeys = 16;
    for (int i = 0; i <= kKeys; ++i) {
        const double angle = kTwoPi * i / kKeys;
        const glm::dvec3 from(std::sin(angle), 0.35, std::cos(angle));
        path.keyframes.push_back(keyframe(kDuration * i / kKeys, center + radius * from, center));
    }
    return path;
}

/// Over the model from corner to corner, looking ahead and down.
CameraPath flyby(const Box& bounds) {
    const glm::dvec3 extent = bounds.extent();
    const double height = bounds.max.y + 0.15 * std::max(extent.x, extent.z);
    const glm::dvec3 from(bounds.min.x - 0.1 * extent.x, height, bounds.min.z - 0.1 * extent.z);
    const glm::dvec3 to(bounds.max.x - 0.2 * extent.x, height, bounds.max.z - 0.2 * extent.z);
    const glm::dvec3 ahead = 0.35 * (to - from) - glm::dvec3(0, height - bounds.center().y, 0);
    return {false, Interpolation::Linear, {keyframe(0, from, from + ahead), keyframe(kDuration, to, to + ahead)}};
}

using TriangleCorners = std::array<glm::dvec3, 3>;

/// Calls `visit` for each triangle of the cut that refines what `isRefined(error, bounds)` says (bounds in local space;
/// monotone along refinements), in world space: pages that it does not reach stay unread, so that it takes as long for
/// a model of any size.
template <class IsRefined, class Visit>
void forEachTriangle(const hierarchy::ModelFile& model, const IsRefined& isRefined, const Visit& visit) {
    const hierarchy::Grid& grid = model.summary().grid;
    for (std::uint32_t id = 0; id < model.pages().size(); ++id) {
        const hierarchy::PageInfo& info = model.pages()[id];
        const bool holdsRoot = info.maxError == std::numeric_limits<double>::infinity();
        if (!holdsRoot && !isRefined(info.maxError, info.bounds)) continue; // none of its groups is drawn
        const hierarchy::Page page = model.readPage(id);
        hierarchy::forEachDrawn(page, isRefined, [&](const hierarchy::Group&, const hierarchy::Cluster& cluster) {
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
                TriangleCorners corners;
                for (std::size_t i = 0; i < corners.size(); ++i)
                    corners[i] = grid.world(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
                visit(corners);
            }
        });
    }
}

/// How far from `origin` along `direction` the triangle is met; infinite if it is not (Moeller, Trumbore 1997).
double hitDistance(const TriangleCorners& t, const glm::dvec3& origin, const glm::dvec3& direction) {
    constexpr double kMissed = std::numeric_limits<double>::infinity();
    const glm::dvec3 along = t[1] - t[0];
    const glm::dvec3 across = t[2] - t[0];
    const glm::dvec3 p = glm::cross(direction, across);
    const double determinant = glm::dot(along, p);
    if (determinant == 0) return kMissed;
    const glm::dvec3 from = origin - t[0];
    const double u = glm::dot(from, p) / determinant;
    const glm::dvec3 q = glm::cross(from, along);
    const double v = glm::dot(direction, q) / determinant;
    const double distance = glm::dot(across, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && distance >= 0) return distance;
    return kMissed;
}

/// How far from `start` along `direction` (unit length) the model at full detail is first met; infinite if it is not.
double surfaceDistance(const hierarchy::ModelFile& model, const glm::dvec3& start, const glm::dvec3& direction) {
    const glm::dvec3 origin = start - model.summary().grid.origin;
    const auto meets = [&](double, const Sphere& sphere) {
        const glm::dvec3 towards = sphere.center - origin;
        const double along = std::max(glm::dot(towards, direction), 0.0);
        return glm::length(towards - along * direction) <= sphere.radius;
    };
    double surface = std::numeric_limits<double>::infinity();
    forEachTriangle(model, meets, [&](const TriangleCorners& corners) {
        surface = std::min(surface, hitDistance(corners, start, direction));
    });
    return surface;
}

/// The point of the model that is nearest in direction to `direction` as seen from `start`, among the vertices of the
/// coarsest cut: every one of them is a vertex at full detail.
glm::dvec3 coarseVertexTowards(
    const hierarchy::ModelFile& model, const glm::dvec3& start, const glm::dvec3& direction) {
    glm::dvec3 nearest(0);
    double best = -2; // a cosine
    forEachTriangle(
        model,
        [](double, const Sphere&) { return false; },
        [&](const TriangleCorners& corners) {
            for (const glm::dvec3& corner : corners) {
                const double cosine = glm::dot(glm::normalize(corner - start), direction);
                if (cosine > best) {
                    best = cosine;
                    nearest = corner;
                }
            }
        });
    return nearest;
}

/// From far away to very near the surface, in equal ratios of the distance from it; towards what of the model lies
/// before its middle or, where nothing does, towards what of it is nearest to that line.
CameraPath approach(const hierarchy::ModelFile& model) {
    const Box& bounds = model.summary().bounds;
    const glm::dvec3 from = glm::normalize(glm::dvec3(0.35, 0.25, 1));
    const glm::dvec3 start = bounds.center() + 2.5 * glm::length(bounds.extent()) * from;
    glm::dvec3 direction = -from;
    double surface = surfaceDistance(model, start, direction);
    if (surface == std::numeric_limits<double>::infinity()) {
        const glm::dvec3 way = coarseVertexTowards(model, start, direction) - start;
        direction = glm::normalize(way);
        surface = std::min(glm::length(way), surfaceDistance(model, start, direction));
    }
    const glm::dvec3 target = start + surface * direction;
    constexpr double kNearest = 1e-3; // of the first distance
    constexpr int kKeys = 24;
    CameraPath path;
    for (int i = 0; i <= kKeys; ++i) {
        const double distance = surface * std::pow(kNearest, static_cast<double>(i) / kKeys);
        path.keyframes.push_back(keyframe(kDuration * i / kKeys, target - distance * direction, target));
    }
    return path;
}

/// Where something stands between ankle and head, seen from above: the boxes of the triangles of a uniform cut, grown
/// by its error.
class WalkMap {
public:
    WalkMap(const hierarchy::ModelFile& model, double ankle, double head, double error)
        : min_(model.summary().bounds.min),
          cell_(model.summary().bounds.extent() / static_cast<double>(kCells)),
          occupied_(static_cast<std::size_t>(kCells) * kCells, 0) {
        const auto isRefined = [error](double groupError, const Sphere&) { return groupError > error; };
        forEachTriangle(model, isRefined, [&](const TriangleCorners& corners) {
            Box box;
            for (const glm::dvec3& corner : corners)
                box.add(corner);
            box = {box.min - error, box.max + error};
            if (box.max.y > ankle && box.min.y < head) mark(box);
        });
    }

    glm::dvec3 center(int x, int z) const { return {min_.x + (x + 0.5) * cell_.x, 0, min_.z + (z + 0.5) * cell_.z}; }

    /// How much stands within a few cells beside the way from `a` to `b`; nothing if the way itself is blocked.
    std::optional<int> thingsBeside(const glm::ivec2& a, const glm::ivec2& b) const {
        const int steps = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
        int things = 0;
        for (int i = 0; i <= steps; ++i) {
            const double t = steps == 0 ? 0 : static_cast<double>(i) / steps;
            const glm::ivec2 at = glm::ivec2(glm::round(glm::mix(glm::dvec2(a), glm::dvec2(b), t)));
            if (count(at, 1) > 0) return std::nullopt;
            things += count(at, 6) > 0 ? 1 : 0;
        }
        return things;
    }

    /// How much there is to see from `at` towards `direction`, from 0 to 1: the fraction of rays, fanned over the view,
    /// that meet something, times how far off the farthest of that is, of a third of the map.
    double outlook(const glm::ivec2& at, const glm::dvec2& direction) const {
        constexpr int kRays = 24;
        constexpr int kReach = kCells / 3;
        constexpr double kSpread = 0.5; // tan of the half angle
        const glm::dvec2 across(-direction.y, direction.x);
        int met = 0;
        int farthest = 0;
        for (int ray = 0; ray < kRays; ++ray) {
            const double slope = kSpread * (2.0 * ray / (kRays - 1) - 1);
            const glm::dvec2 step = glm::normalize(direction + slope * across);
            for (int i = 1; i < kReach; ++i) {
                const glm::ivec2 cell = glm::ivec2(glm::round(glm::dvec2(at) + static_cast<double>(i) * step));
                if (count(cell, 0) == 0) continue;
                ++met;
                farthest = std::max(farthest, i);
                break;
            }
        }
        return static_cast<double>(met) / kRays * farthest / kReach;
    }

private:
    void mark(const Box& box) {
        const glm::ivec3 first = cellOf(box.min);
        const glm::ivec3 last = cellOf(box.max);
        for (int z = first.z; z <= last.z; ++z)
            for (int x = first.x; x <= last.x; ++x)
                occupied_[static_cast<std::size_t>(z) * kCells + static_cast<std::size_t>(x)] = 1;
    }

    glm::ivec3 cellOf(const glm::dvec3& p) const {
        const glm::dvec3 size = glm::max(cell_, glm::dvec3(1e-300));
        return glm::clamp(glm::ivec3(glm::floor((p - min_) / size)), glm::ivec3(0), glm::ivec3(kCells - 1));
    }

    int count(const glm::ivec2& at, int reach) const {
        int result = 0;
        for (int z = std::max(at.y - reach, 0); z <= std::min(at.y + reach, kCells - 1); ++z)
            for (int x = std::max(at.x - reach, 0); x <= std::min(at.x + reach, kCells - 1); ++x)
                result += occupied_[static_cast<std::size_t>(z) * kCells + static_cast<std::size_t>(x)];
        return result;
    }

    glm::dvec3 min_;
    glm::dvec3 cell_;
    std::vector<std::uint8_t> occupied_;
};

CameraPath walk(const hierarchy::ModelFile& model) {
    const Box& bounds = model.summary().bounds;
    const double width = std::max(bounds.extent().x, bounds.extent().z);
    const double eyeHeight = width > 20 ? 1.7 : 0.02 * width; // metres where the model is large enough to be in metres
    const double ground = std::max(bounds.min.y, std::min(0.0, bounds.max.y));
    const WalkMap map(model, ground + 0.2 * eyeHeight, ground + 1.2 * eyeHeight, 0.05 * eyeHeight);
    Random random(1);
    const auto cell = [&] { return static_cast<int>(random.below(kCells)); };
    double best = 0;
    std::pair<glm::ivec2, glm::ivec2> way;
    for (int trial = 0; trial < 20000; ++trial) {
        const glm::ivec2 a(cell(), cell());
        const glm::ivec2 b(cell(), cell());
        const double length = glm::length(glm::dvec2(b - a));
        if (length < kCells / 16.0 || length > kCells / 3.0) continue;
        const auto things = map.thingsBeside(a, b);
        if (!things || *things + 0.1 * length <= best) continue; // the outlook takes longest and is at most 1
        const double score = (*things + 0.1 * length) * map.outlook(b, glm::dvec2(b - a) / length);
        if (score > best) {
            best = score;
            way = {a, b};
        }
    }
    if (best == 0) throw Error(model.path(), "no free way for a walk at eye height", "a way between things", "none");
    const glm::dvec3 up(0, ground + eyeHeight, 0);
    const glm::dvec3 from = map.center(way.first.x, way.first.y) + up;
    const glm::dvec3 to = map.center(way.second.x, way.second.y) + up;
    const glm::dvec3 ahead = glm::normalize(to - from) * width;
    return {false, Interpolation::Linear, {keyframe(0, from, from + ahead), keyframe(kDuration, to, to + ahead)}};
}

} // namespace

CameraPath suitedPath(const hierarchy::ModelFile& model, const std::string& kind) {
    const Box& bounds = model.summary().bounds;
    if (kind == "orbit") return orbit(bounds);
    if (kind == "flyby") return flyby(bounds);
    if (kind == "approach") return approach(model);
    return walk(model);
}

} // namespace gnomon::path
