#include "path/walk.h"

#include "core/angle.h"
#include "core/error.h"
#include "path/storeys.h"
#include "path/way_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace gnomon::path {

namespace {

constexpr double kLongest = 60;    // seconds
constexpr double kRegionSide = 47; // in eye heights: 80 m
constexpr double kCoarseCells = 1024;
constexpr std::size_t kRegions = 4; // max number of tried regions
constexpr double kShortest = 1.2;   // min length of a walk, in eye heights
constexpr double kGoodLength = 18;  // in eye heights: a walk of this length ends the search over regions

double widthOf(const Box& bounds) {
    return std::max(bounds.extent().x, bounds.extent().z);
}

/// Returns true if the size of a model suggests a room, a building, a plant or a landscape in metres. The model must
/// not be small, and not higher than buildings of its width.
bool metresFit(const Box& bounds) {
    const double width = widthOf(bounds);
    const double height = bounds.extent().y;
    if (width < 2.5) return false;
    return height <= 0.1 * width || (height <= 500 && width <= 2000);
}

/// Returns a walk around an object that lies on a ground at the height of its lowest point. The walk makes one and a
/// half turns and comes nearer. It stays outside the circle around the object's bounds and looks at the object.
CameraPath walkAround(const Box& bounds, const std::optional<double>& toldEyeHeight) {
    const glm::dvec3 extent = bounds.extent();
    const double width = widthOf(bounds);
    const double eyeHeight = toldEyeHeight.value_or(0.25 * std::max(extent.y, 0.2 * width));
    const double circle = 0.5 * std::hypot(extent.x, extent.z);
    const double eyeY = bounds.min.y + eyeHeight;
    const double aim = std::min(eyeY, bounds.max.y) + 0.3 * std::max(0.0, bounds.max.y - eyeY);
    const glm::dvec3 target(bounds.center().x, aim, bounds.center().z);
    constexpr int kKeys = 96;
    constexpr double kTurns = 1.5;
    CameraPath path;
    double length = 0;
    for (int i = 0; i <= kKeys; ++i) {
        const double share = static_cast<double>(i) / kKeys;
        const double angle = 2 * kPi * kTurns * share;
        const double radius = circle * (2.2 - 1.0 * share) + 0.3 * eyeHeight;
        const glm::dvec3 eye(target.x + radius * std::sin(angle), eyeY, target.z + radius * std::cos(angle));
        if (i > 0) length += glm::distance(eye, path.keyframes.back().camera.eye);
        path.keyframes.push_back(keyframeAt(length, eye, target));
    }
    const double pace = std::max(WalkBody::ofEyeHeight(eyeHeight).pace, length / kLongest);
    for (Keyframe& key : path.keyframes)
        key.time /= pace;
    return path;
}

/// Returns how many points of the route `way` remain after its last points in front of a wall are removed. At most a
/// twelfth of the points are removed.
std::size_t trimmedEnd(const WalkableFloor& floor, const std::vector<WayPoint>& way) {
    const double minStraight = 2.2 * floor.body().eyeHeight / floor.grid().cell;
    std::size_t end = way.size();
    for (; end > way.size() - way.size() / 12; --end) {
        const WayPoint& last = way[end - 1];
        const glm::dvec2 ahead = glm::normalize(last.at - way[end - 2].at);
        if (runStraight(floor, last, last.at + minStraight * ahead).end != FloorCell::kNone) break;
    }
    return end;
}

/// Returns the positions of the eye along the route `way`: at eye height above the floor, but smoothed on stairs. The
/// smoothing changes the distance to floor or ceiling by at most half a step.
std::vector<glm::dvec3> eyesAlong(const WalkableFloor& floor, const std::vector<WayPoint>& way) {
    const WalkBody& body = floor.body();
    const ColumnGrid& grid = floor.grid();
    std::vector<glm::dvec3> eyes;
    for (const WayPoint& point : way) {
        const double height = floor.height(floor.cells()[point.cell].floor);
        eyes.push_back(grid.origin + glm::dvec3(point.at.x * grid.cell, 0, point.at.y * grid.cell));
        eyes.back().y = height + body.eyeHeight;
    }
    const std::vector<glm::dvec3> uneven = eyes;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        const auto reach = std::min<std::size_t>({2, i, eyes.size() - 1 - i});
        double sum = 0;
        for (std::size_t j = i - reach; j <= i + reach; ++j)
            sum += uneven[j].y;
        const double even = sum / static_cast<double>(2 * reach + 1);
        eyes[i].y = std::clamp(even, uneven[i].y - 0.4 * body.step, uneven[i].y + 0.15 * body.step);
    }
    return eyes;
}

/// Returns a camera path along the route `way`. The camera looks at the position after the next strides if no corner
/// hides it, and turns smoothly.
CameraPath walkAlong(const WalkableFloor& floor, const std::vector<WayPoint>& way) {
    const WalkBody& body = floor.body();
    const std::vector<glm::dvec3> eyes = eyesAlong(floor, way);
    const double ahead = 1.5 * body.eyeHeight;
    const auto count = eyes.size();
    std::vector<glm::dvec3> gazes;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t to = i + 1;
        while (to + 1 < count && glm::distance(eyes[to], eyes[i]) < ahead &&
               runStraight(floor, way[i], way[to + 1].at).end == way[to + 1].cell)
            ++to;
        gazes.push_back(to < count ? glm::normalize(eyes[to] - eyes[i]) : gazes.back());
        gazes.back().y *= 0.5; // on stairs, the view is less steep than the way
    }
    CameraPath path;
    double length = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto reach = std::min<std::size_t>({4, i, count - 1 - i});
        glm::dvec3 gaze(0);
        for (std::size_t j = i - reach; j <= i + reach; ++j)
            gaze += gazes[j];
        if (glm::length(gaze) < 0.1) gaze = gazes[i]; // the way turns back
        if (i > 0) length += glm::distance(eyes[i], eyes[i - 1]);
        path.keyframes.push_back(
            keyframeAt(length / body.pace, eyes[i], eyes[i] + 4 * body.eyeHeight * glm::normalize(gaze)));
    }
    return path;
}

std::string sizeOf(const Box& bounds) {
    std::array<char, 96> text{};
    const glm::dvec3 size = bounds.extent();
    std::snprintf(text.data(), text.size(), "none in a model of %.4g x %.4g x %.4g", size.x, size.y, size.z);
    return text.data();
}

constexpr const char* kLevelPlace = "a level place with a body's room around and above it, at this height of the eye";

Error noFloor(const hierarchy::ModelFile& model, const char* expected) {
    return {model.path(), "no floor to walk on", expected, sizeOf(model.summary().bounds)};
}

/// The floors on which a walk may lead: the floor of the whole model, or the best regions of a model that is too large.
class Ground {
public:
    Ground(const hierarchy::ModelFile& model, const WalkBody& body, const std::optional<int>& storey)
        : model_(model),
          body_(body),
          isWhole_(widthOf(uprightBounds(model)) <= kRegionSide * body.eyeHeight),
          whole_(floorOf(
              model,
              uprightBounds(model),
              body,
              isWhole_ ? fineCell(body) : widthOf(uprightBounds(model)) / kCoarseCells)) {
        if (!storey) return;
        const std::vector<Storey> storeys = findStoreys(whole_);
        if (storeys.empty()) throw noFloor(model, kLevelPlace);
        if (*storey < 0 || static_cast<std::size_t>(*storey) >= storeys.size())
            throw Error(model.path(), "unknown storey", listOf(storeys), std::to_string(*storey));
        band_ = bandOf(storeys, static_cast<std::size_t>(*storey), body);
    }

    /// Returns the walk over the best region, or nullopt if no region has a walk.
    std::optional<CameraPath> walk() const {
        if (isWhole_) return walkOver(whole_);
        std::optional<CameraPath> longest;
        for (Box region : bestRegions(whole_, band_, kRegionSide * body_.eyeHeight, kRegions)) {
            region.min.y = uprightBounds(model_).min.y;
            region.max.y = uprightBounds(model_).max.y;
            std::optional<CameraPath> path = walkOver(floorOf(model_, region, body_, fineCell(body_)));
            if (path && (!longest || path->duration() > longest->duration())) longest = std::move(path);
            if (longest && longest->duration() * body_.pace > kGoodLength * body_.eyeHeight) break;
        }
        return longest;
    }

private:
    std::optional<CameraPath> walkOver(const WalkableFloor& floor) const {
        const std::optional<FoundWay> found = findWay(floor, {band_.low, band_.high, kLongest * body_.pace});
        if (!found || found->length < kShortest * body_.eyeHeight) return std::nullopt;
        std::vector<WayPoint> way = smoothWay(floor, found->cells);
        way.resize(trimmedEnd(floor, way));
        return walkAlong(floor, way);
    }

    const hierarchy::ModelFile& model_;
    WalkBody body_;
    HeightBand band_;
    bool isWhole_;
    WalkableFloor whole_;
};

} // namespace

CameraPath walk(const hierarchy::ModelFile& model, const WalkOptions& options) {
    const Box bounds = uprightBounds(model);
    const double metre = 1 / hierarchy::rowOf(model.summary().unit).metres;
    const bool isInMetres = options.eyeHeight || metresFit({bounds.min / metre, bounds.max / metre});
    const WalkBody body = WalkBody::ofEyeHeight(options.eyeHeight.value_or(WalkBody{}.eyeHeight * metre));
    if (isInMetres)
        if (const auto path = Ground(model, body, options.storey).walk()) return *path;
    if (!options.storey && (!isInMetres || widthOf(bounds) < 12 * body.eyeHeight))
        return walkAround(bounds, options.eyeHeight);
    throw noFloor(
        model, isInMetres ? kLevelPlace : "storeys of a model in metres, or to be told the height of the eye");
}

} // namespace gnomon::path
