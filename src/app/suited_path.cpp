#include "app/suited_path.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::app {

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

/// From far away to very near, in equal ratios of the distance.
CameraPath approach(const Box& bounds) {
    CameraPath path;
    const glm::dvec3 center = bounds.center();
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.35, 0.25, 1));
    const double radius = 0.5 * glm::length(bounds.extent());
    constexpr int kKeys = 24;
    for (int i = 0; i <= kKeys; ++i) {
        const double beyond = 4 * radius * std::pow(0.002, static_cast<double>(i) / kKeys);
        path.keyframes.push_back(keyframe(kDuration * i / kKeys, center + direction * (radius + beyond), center));
    }
    return path;
}

/// Where something stands between ankle and head, seen from above.
class WalkMap {
public:
    WalkMap(const hierarchy::ModelFile& model, double ankle, double head)
        : min_(model.summary().bounds.min),
          cell_(model.summary().bounds.extent() / static_cast<double>(kCells)),
          occupied_(static_cast<std::size_t>(kCells) * kCells, 0) {
        const hierarchy::Grid& grid = model.summary().grid;
        for (std::uint32_t id = 0; id < model.pages().size(); ++id) {
            if (model.pages()[id].level != 0) continue;
            const hierarchy::Page page = model.readPage(id);
            for (const hierarchy::Cluster& cluster : page.clusters)
                for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
                    Box box;
                    for (const std::uint8_t corner : page.triangles[cluster.firstTriangle + t])
                        box.add(grid.world(page.vertices[cluster.firstVertex + corner].position));
                    if (box.max.y > ankle && box.min.y < head) mark(box);
                }
        }
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
    const WalkMap map(model, ground + 0.2 * eyeHeight, ground + 1.2 * eyeHeight);
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
        if (things && *things + 0.1 * length > best) {
            best = *things + 0.1 * length;
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
    if (kind == "approach") return approach(bounds);
    return walk(model);
}

} // namespace gnomon::app
