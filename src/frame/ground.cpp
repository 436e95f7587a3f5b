#include "frame/ground.h"

#include "frame/scene_facts.h"
#include "hierarchy/upright_frame.h"
#include "lod/error_rule.h"
#include "plan/light_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::frame {

namespace {

constexpr double kMaxShadow = 16;  // max length of a shadow on the ground, in diagonals of the model
constexpr double kMinLight = 1e-4; // below this sine of the light's elevation, there is no ground shadow
// Distance up to which the ground shows occluded sky light, in heights of the model. Beyond it, even a wide wall hides
// less than 0.4% of the sky.
constexpr double kSkyReach = 8;

using Polygon = std::vector<glm::dvec3>;

/// Returns the min of dot(up, p) over the page boxes of the model: the height of the model's lowest point.
double lowestPoint(const ModelExtent& model, const glm::dvec3& up) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const hierarchy::PageInfo& page : model.pages) {
        const Box box = model.grid.local(page.box);
        lowest = std::min(lowest, glm::dot(up, box.center()) - glm::dot(glm::abs(up), box.extent() * 0.5));
    }
    return lowest + glm::dot(up, model.grid.origin);
}

/// Returns the part of a convex polygon on the inner side of a plane.
Polygon clipped(const Polygon& polygon, const Plane& plane) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double atA = plane.signedDistance(a);
        const double atB = plane.signedDistance(b);
        if (atA >= 0) result.push_back(a);
        if ((atA >= 0) != (atB >= 0)) result.push_back(glm::mix(a, b, atA / (atA - atB)));
    }
    return result;
}

Polygon clipped(Polygon polygon, const ConvexVolume& volume) {
    for (const Plane& plane : volume.planes)
        if (!polygon.empty()) polygon = clipped(polygon, plane);
    return polygon;
}

/// Returns the convex hull of points that lie in a plane perpendicular to `up`, counter-clockwise as seen from above
/// (Andrew 1979).
Polygon hullOf(Polygon points, const glm::dvec3& up) {
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
    const auto flat = [&](const glm::dvec3& p) {
        return glm::dvec2(glm::dot(p, frame.right), glm::dot(p, frame.front));
    };
    std::sort(points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec2 u = flat(a);
        const glm::dvec2 v = flat(b);
        return u.x < v.x || (u.x == v.x && u.y < v.y);
    });
    const auto turnsRight = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const glm::dvec2 u = flat(b - a);
        const glm::dvec2 v = flat(c - a);
        return u.x * v.y - u.y * v.x <= 0;
    };
    Polygon hull;
    const auto half = [&](auto begin, auto end) {
        const std::size_t first = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= first + 2 && turnsRight(hull[hull.size() - 2], hull.back(), *p))
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();
    };
    half(points.begin(), points.end());
    half(points.rbegin(), points.rend());
    std::reverse(hull.begin(), hull.end()); // right x front points down, so the hull is clockwise from above
    return hull;
}

std::array<glm::dvec3, 8> cornersOf(const Box& bounds) {
    std::array<glm::dvec3, 8> corners{};
    for (unsigned corner = 0; corner < corners.size(); ++corner)
        corners.at(corner) = {
            (corner & 1U) != 0 ? bounds.max.x : bounds.min.x,
            (corner & 2U) != 0 ? bounds.max.y : bounds.min.y,
            (corner & 4U) != 0 ? bounds.max.z : bounds.min.z};
    return corners;
}

/// Adds the corners of the shadow that the bounding box `bounds` throws onto the plane dot(up, p) = `height`. The
/// length of the shadow is limited to kMaxShadow diagonals of the box.
void addShadow(
    const Box& bounds, const glm::dvec3& up, double height, const glm::dvec3& towardsLight, Polygon& points) {
    const double longest = kMaxShadow * glm::length(bounds.extent());
    for (const glm::dvec3& p : cornersOf(bounds)) {
        const double above = std::max(glm::dot(up, p) - height, 0.0);
        const glm::dvec3 under = p - up * (glm::dot(up, p) - height);
        const glm::dvec3 level = towardsLight - up * glm::dot(up, towardsLight);
        const double length = above * glm::length(level) / glm::dot(up, towardsLight);
        const double part = length > longest ? longest / length : 1;
        points.push_back(under - level * (part * above / glm::dot(up, towardsLight)));
        points.push_back(under);
    }
}

/// Adds points on the ground around the box `bounds`, at a distance of kSkyReach times the height of each corner. Also
/// adds the corners of the box's shadow for the whole disc of the sun.
void addSkyReach(const plan::View& view, const Box& bounds, const glm::dvec3& up, double height, Polygon& points) {
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
    const double aslant = std::sqrt(0.5);
    for (const glm::dvec3& p : cornersOf(bounds)) {
        const double above = glm::dot(up, p) - height;
        const double reach = kSkyReach * above;
        for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(aslant, aslant), glm::dvec2(0, 1)})
            for (const glm::dvec2 sign : {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)})
                points.push_back(
                    p - up * above + reach * (sign.x * way.x * frame.right + sign.y * way.y * frame.front));
    }
    for (const glm::dvec2 rim : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
        const glm::dvec3 light = glm::normalize(plan::towardsDisc(view.towardsLight, view.sunAngleRadians, rim));
        if (glm::dot(up, light) > kMinLight) addShadow(bounds, up, height, light, points);
    }
}

/// Returns the convex hull of points in the plane perpendicular to `up`, clipped to the coordinate range of the model's
/// grid.
Polygon outlineOf(const ModelExtent& model, const glm::dvec3& up, Polygon points) {
    const Box& bounds = model.bounds;
    // The clipping limits the differences of grid coordinates to 32 bits.
    const double widest = std::max({bounds.extent().x, bounds.extent().y, bounds.extent().z});
    const double reach = 0.99 * model.grid.step() * hierarchy::kMaxGridCoordinate - widest;
    ConvexVolume within;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0);
        normal[axis] = 1;
        within.planes.push_back({normal, std::max(reach, 0.0) - bounds.min[axis]});
        within.planes.push_back({-normal, std::max(reach, 0.0) + bounds.max[axis]});
    }
    return clipped(hullOf(std::move(points), up), within);
}

/// Converts the ground polygon to a page with a fan of triangles on the model's grid, below the ground plane. The
/// corners are shifted down by one grid step and then rounded down, so that rounding never lifts them above the plane.
hierarchy::Page pageOf(const Polygon& outline, const hierarchy::Grid& grid, const glm::dvec3& up) {
    hierarchy::Page page;
    hierarchy::Cluster cluster;
    // Negative coordinates wrap modulo 2^32, but differences of coordinates are still correct.
    const auto point = [](const glm::dvec3& cells) {
        const glm::i64vec3 whole(cells);
        return hierarchy::GridPoint{
            static_cast<std::uint32_t>(whole.x),
            static_cast<std::uint32_t>(whole.y),
            static_cast<std::uint32_t>(whole.z)};
    };
    Box cells;
    for (const glm::dvec3& corner : outline) {
        const glm::dvec3 cell = glm::floor((corner - grid.origin) / grid.step() - up);
        cells.add(cell);
        hierarchy::Vertex vertex;
        vertex.position = point(cell);
        page.vertices.push_back(vertex);
    }
    cluster.box = {point(cells.min), point(cells.max)};
    for (std::size_t i = 2; i < outline.size(); ++i)
        page.triangles.push_back({0, static_cast<std::uint8_t>(i - 1), static_cast<std::uint8_t>(i)});
    cluster.vertexCount = static_cast<std::uint32_t>(page.vertices.size());
    cluster.triangleCount = static_cast<std::uint32_t>(page.triangles.size());
    page.clusters.push_back(cluster);
    return page;
}

bool isSeenFromAbove(const plan::View& view, const glm::dvec3& up, double height) {
    const Camera& camera = view.camera;
    return camera.isParallel() ? glm::dot(camera.target - camera.eye, up) < 0 : glm::dot(camera.eye, up) > height;
}

} // namespace

std::shared_ptr<const Ground> groundOf(
    const plan::View& view, const plan::ShadingSettings& look, const ModelExtent& model, bool reachesSky) {
    const glm::dvec3 up = glm::normalize(view.up);
    const glm::dvec3 towardsLight = view.light().unit();
    const bool isLit = glm::dot(up, towardsLight) > kMinLight && !plan::hasNoSun(look.shading);
    if (!look.ground || !isLit || model.pages.empty()) return nullptr;
    const double height = lowestPoint(model, up);
    if (!isSeenFromAbove(view, up, height)) return nullptr;
    auto ground = std::make_shared<Ground>();
    Polygon points;
    addShadow(model.bounds, up, height, towardsLight, points);
    if (reachesSky) addSkyReach(view, model.bounds, up, height, points);
    ground->outline = outlineOf(model, up, std::move(points));
    if (ground->outline.size() < 3) return nullptr;
    ground->page = pageOf(ground->outline, model.grid, up);
    return ground;
}

bool addGround(const Ground& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts) {
    const glm::dvec3 eye = view.camera.eye;
    const Polygon shown = clipped(ground.outline, lod::viewPyramid(detailView(view, eye)));
    if (shown.empty()) return false;
    const CameraBasis basis = cameraBasis(view.camera);
    const double slack = 4 * gridStep;
    DepthSpan depths{std::numeric_limits<double>::infinity(), 0};
    Box box;
    for (const glm::dvec3& corner : shown) {
        const double depth = glm::dot(basis.view, corner - eye);
        depths = {std::min(depths.near, std::max(depth - slack, 0.0)), std::max(depths.far, depth + slack)};
        box.add(corner - eye);
    }
    for (const glm::dvec3& corner : ground.outline)
        facts.bounds.add(corner);
    plan::SceneFacts::Visible visible = facts.visible.value_or(plan::SceneFacts::Visible{});
    visible.nearest = visible.anything ? std::min(visible.nearest, depths.near) : depths.near;
    visible.farthest = visible.anything ? std::max(visible.farthest, depths.far) : depths.far;
    visible.anything = true;
    facts.visible = visible;
    facts.isTurnedFromLight = false;
    if (!facts.light) return true;
    plan::SceneFacts::Light& light = *facts.light;
    light.canBeShadowed = true;
    light.seen.push_back({depths, {box.min - slack, box.max + slack}});
    std::vector<DepthSpan> lit = std::move(light.lit);
    lit.push_back(depths);
    std::sort(lit.begin(), lit.end(), [](const DepthSpan& a, const DepthSpan& b) { return a.near < b.near; });
    light.lit.clear();
    for (const DepthSpan& span : lit) {
        if (!light.lit.empty() && span.near <= light.lit.back().far)
            light.lit.back().far = std::max(light.lit.back().far, span.far);
        else
            light.lit.push_back(span);
    }
    return true;
}

std::shared_ptr<const Ground> seenGround(
    const std::shared_ptr<const Ground>& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts) {
    return ground && addGround(*ground, view, gridStep, facts) ? ground : nullptr;
}

Box withGround(Box model, const Ground* ground) {
    if (ground != nullptr)
        for (const glm::dvec3& corner : ground->outline)
            model.add(corner);
    return model;
}

double longestShadow(const Ground& ground, const plan::View& view, const Box& model) {
    const glm::dvec3 up = glm::normalize(view.up);
    const double top = glm::dot(up, model.center()) + glm::dot(glm::abs(up), model.extent() * 0.5);
    return (top - glm::dot(up, ground.outline.front())) / glm::dot(up, view.light().unit());
}

} // namespace gnomon::frame
