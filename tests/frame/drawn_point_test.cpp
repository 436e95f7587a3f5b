// The point of a triangle that is seen at a pixel: against every triangle that was drawn, and against the source.
#include "core/random.h"
#include "frame/drawn_point.h"
#include "inspect/cells.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace gnomon::frame {
namespace {

using Corners = std::array<glm::dvec3, 3>; // world space

tests::TinyModel hills(std::uint64_t seed) {
    tests::TinyModelOptions options;
    options.seed = seed;
    options.height = 30; // so that they hide each other
    options.origin = {500000, 300, 5.2e6};
    return tests::makeTinyModel(options);
}

void addTriangles(
    const hierarchy::Page& page,
    const hierarchy::Cluster& cluster,
    const hierarchy::Grid& grid,
    std::vector<Corners>& all) {
    for (std::uint32_t i = 0; i < cluster.triangleCount; ++i) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] =
                grid.world(page.vertices[cluster.firstVertex + page.triangles[cluster.firstTriangle + i][k]].position);
        all.push_back(corners);
    }
}

std::vector<Corners> drawnTriangles(DrawnModel& model, const Frame& frame) {
    std::vector<Corners> all;
    const auto resident = model.renderer().residency().resident();
    for (const lod::ClusterRange& range : frame.cut.lists.image.ranges)
        for (std::uint32_t i = 0; i < range.clusterCount; ++i)
            addTriangles(
                *resident[range.page],
                resident[range.page]->clusters[range.firstCluster + i],
                model.file().summary().grid,
                all);
    return all;
}

/// The first point of `triangles` on a line, by solving three equations a triangle; nothing before `minParameter`.
std::optional<glm::dvec3> firstOn(
    const std::vector<Corners>& triangles, const glm::dvec3& start, const glm::dvec3& direction, double minParameter) {
    std::optional<double> first;
    for (const Corners& t : triangles) {
        const glm::dmat3 equations(t[1] - t[0], t[2] - t[0], -direction);
        if (glm::determinant(equations) == 0) continue;
        const glm::dvec3 solved = glm::inverse(equations) * (start - t[0]);
        const bool isInside = solved.x >= -1e-12 && solved.y >= -1e-12 && solved.x + solved.y <= 1 + 1e-12;
        if (isInside && solved.z > minParameter && solved.z < first.value_or(1e300)) first = solved.z;
    }
    return first ? std::optional(start + direction * *first) : std::nullopt;
}

struct PixelLine {
    glm::dvec3 start{0};
    glm::dvec3 direction{0};
};

PixelLine lineOf(const plan::View& view, const glm::ivec2& pixel) {
    const CameraBasis basis = cameraBasis(view.camera);
    const double x = (2 * (pixel.x + 0.5) / view.width - 1) * view.aspect();
    const double y = 1 - 2 * (pixel.y + 0.5) / view.height;
    if (view.camera.isParallel()) {
        const double half = halfHeightAtTarget(view.camera);
        return {view.camera.eye + toWorld(basis, {x * half, y * half, 0}), basis.view};
    }
    const double half = view.tanHalfY();
    return {view.camera.eye, toWorld(basis, {x * half, y * half, 1})};
}

plan::View randomView(Random& random, const Box& bounds, int round) {
    plan::View view;
    view.width = 96;
    view.height = 64;
    const glm::dvec3 middle = (bounds.min + bounds.max) / 2.0;
    view.camera.target = middle + glm::dvec3(random.uniform(-5, 5), 0, random.uniform(-5, 5));
    view.camera.eye = middle + glm::dvec3(random.uniform(-25, 25), random.uniform(0, 12), random.uniform(-25, 25));
    if (round % 3 == 1) view.camera.projection = Projection::Orthographic;
    if (round % 3 == 2) view.sections = {{glm::normalize(glm::dvec3(1, 0.3, 0.2)), 0}};
    for (Plane& plane : view.sections)
        plane.offset = -glm::dot(plane.normal, middle);
    return view;
}

/// Where sections let a line begin to see, as a parameter along it; hills close nothing, so there are no caps.
double minSeen(const plan::View& view, const PixelLine& line) {
    double minParameter = view.camera.isParallel() ? -1e9 : 0;
    for (const Plane& plane : view.sections) {
        const double along = glm::dot(plane.normal, line.direction);
        if (along > 0) minParameter = std::max(minParameter, -plane.signedDistance(line.start) / along);
    }
    return minParameter;
}

/// A view of hills that was drawn, and the points of its pixels.
class DrawnHills {
public:
    DrawnHills(std::uint64_t seed, Random& random, int kind, double errorPixels)
        : hills_(hills(seed)), model_(hills_), view_(randomView(random, model_.file().summary().bounds, kind)) {
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Off;
        quality.errorPixels = errorPixels;
        frame_ = model_.draw(view_, quality);
        triangles_ = drawnTriangles(model_, frame_);
    }

    const tests::TinyModel& source() const { return hills_; }

    glm::dvec3 world(const GridPlace& place) const { return inspect::worldOf(hills_.summary.grid, place.cell); }

    std::optional<DrawnPoint> at(const glm::ivec2& pixel) { return drawnPoint(model_.renderer(), frame_, {}, pixel); }

    std::optional<glm::dvec3> expectedAt(const glm::ivec2& pixel) const {
        const PixelLine line = lineOf(view_, pixel);
        const auto first = firstOn(triangles_, line.start, line.direction, minSeen(view_, line));
        for (const Plane& plane : view_.sections)
            if (first && plane.signedDistance(*first) < 0) return std::nullopt;
        return first;
    }

    /// Whether the picture, which rounds to its own places within a pixel, shows something else than `point` there.
    bool isDrawnElsewhere(const glm::ivec2& pixel, const glm::dvec3& point) {
        const double depth = glm::dot(point - view_.camera.eye, cameraBasis(view_.camera).view);
        return std::abs(model_.backend().viewDepth().at(pixel.x, pixel.y) - depth) > 0.01 * std::abs(depth);
    }

    /// How far `point` is from the section of the view, which has one.
    double toSection(const glm::dvec3& point) const { return std::abs(view_.sections.at(0).signedDistance(point)); }

    bool isDrawnVertex(const glm::i64vec3& cell) const {
        const glm::dvec3 world = inspect::worldOf(hills_.summary.grid, cell);
        return std::any_of(triangles_.begin(), triangles_.end(), [&](const Corners& corners) {
            return std::find(corners.begin(), corners.end(), world) != corners.end();
        });
    }

private:
    tests::TinyModel hills_;
    DrawnModel model_;
    plan::View view_;
    Frame frame_;
    std::vector<Corners> triangles_;
};

glm::ivec2 randomPixel(Random& random) {
    const auto column = static_cast<int>(random.below(96));
    return {column, static_cast<int>(random.below(64))};
}

TEST(DrawnPoint, IsTheFirstOfAllDrawnTrianglesOnTheLineOfSight) {
    Random random(11);
    int seen = 0, missed = 0, apart = 0;
    for (int round = 0; round < 12; ++round) {
        DrawnHills drawn(static_cast<std::uint64_t>(round) + 1, random, round, round % 2 == 0 ? 1 : 6);
        const double step = drawn.source().summary.grid.step();
        for (int i = 0; i < 150; ++i) {
            const glm::ivec2 pixel = randomPixel(random);
            const auto found = drawn.at(pixel);
            if (found && !found->vertex) { // the line in which a section meets the hills
                ASSERT_LE(drawn.toSection(drawn.world(found->point)), 0.9 * step);
                continue;
            }
            const auto expected = drawn.expectedAt(pixel);
            ASSERT_EQ(found.has_value(), expected.has_value()) << round << ", " << pixel.x << ", " << pixel.y;
            ++(found ? seen : missed);
            if (!found) continue;
            const glm::dvec3 at = drawn.world(found->point);
            ASSERT_LE(glm::distance(at, *expected), 0.9 * step + 1e-8);
            ASSERT_TRUE(drawn.isDrawnVertex(found->vertex->cell));
            apart += drawn.isDrawnElsewhere(pixel, at) ? 1 : 0;
        }
    }
    EXPECT_GT(seen, 600);
    EXPECT_GT(missed, 60);
    EXPECT_LT(apart, seen / 50); // at outlines
}

std::vector<Corners> sourceTriangles(const tests::TinyModel& model) {
    std::vector<Corners> source;
    for (const hierarchy::Page& page : model.pages)
        if (page.level == 0)
            for (const hierarchy::Cluster& cluster : page.clusters)
                addTriangles(page, cluster, model.summary.grid, source);
    return source;
}

TEST(DrawnPoint, SaysHowFarTheSourceMayBe) {
    Random random(12);
    double maxError = 0;
    for (std::uint64_t round = 0; round < 4; ++round) {
        DrawnHills drawn(round + 31, random, 0, 4);
        const std::vector<Corners> source = sourceTriangles(drawn.source());
        const auto expectNear = [&](const GridPlace& place) {
            const glm::dvec3 at = drawn.world(place);
            const auto below = firstOn(source, at + glm::dvec3(0, 1000, 0), {0, -1, 0}, 0);
            if (!below) return; // the rounding took it over the edge
            EXPECT_LE(std::abs(below->y - at.y), place.within + 1e-6);
            maxError = std::max(maxError, std::abs(below->y - at.y) / place.within);
        };
        for (int i = 0; i < 60; ++i)
            if (const auto found = drawn.at(randomPixel(random))) {
                expectNear(found->point);
                expectNear(*found->vertex);
            }
    }
    EXPECT_GT(maxError, 0.3); // else the bound says little
}

/// A box that stands by itself, whose hits are known: the first slab plane that the line meets on the kept side.
struct SolidBox {
    Box box;
    std::vector<Plane> sections;

    bool isKept(const glm::dvec3& point) const {
        return std::all_of(
            sections.begin(), sections.end(), [&](const Plane& plane) { return plane.signedDistance(point) >= 0; });
    }

    /// The part of a line that runs in what sections leave of the box; empty where it misses that.
    std::array<double, 2> inside(const PixelLine& line) const {
        std::array<double, 2> part = {-1e9, 1e9};
        const auto cut = [&](double distance, double along) { // keeps distance + t along >= 0
            if (along > 0)
                part[0] = std::max(part[0], -distance / along);
            else if (along < 0)
                part[1] = std::min(part[1], -distance / along);
            else if (distance < 0)
                part[1] = -1e300;
        };
        for (int axis = 0; axis < 3; ++axis) {
            cut(line.start[axis] - box.min[axis], line.direction[axis]);
            cut(box.max[axis] - line.start[axis], -line.direction[axis]);
        }
        for (const Plane& plane : sections)
            cut(plane.signedDistance(line.start), glm::dot(plane.normal, line.direction));
        return part;
    }

    /// Whether `point` lies on the plane of a section rather than on a side.
    bool isOnCap(const glm::dvec3& point) const {
        return std::any_of(sections.begin(), sections.end(), [&](const Plane& plane) {
            return std::abs(plane.signedDistance(point)) < 1e-6;
        });
    }
};

plan::View viewOfBox(Random& random, const SolidBox& solid, int round) {
    plan::View view;
    view.width = 96;
    view.height = 64;
    view.sections = solid.sections;
    view.camera.target = solid.box.center();
    const glm::dvec3 from(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    view.camera.eye = solid.box.center() + glm::normalize(from) * 30.0;
    view.camera.fovYRadians = 0.6;
    if (round % 2 == 1) view.camera.projection = Projection::Orthographic;
    return view;
}

SolidBox randomBox(Random& random, const glm::dvec3& origin, int round) {
    SolidBox solid;
    for (int axis = 0; axis < 3; ++axis) { // on the grid, so that nothing is rounded
        const double half = std::round(random.uniform(2, 6) * 64) / 64;
        solid.box.min[axis] = origin[axis] - half;
        solid.box.max[axis] = origin[axis] + half;
    }
    for (int i = 0; i < round % 3; ++i) {
        const glm::dvec3 normal(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        Plane plane{glm::normalize(normal), 0};
        plane.offset = -glm::dot(plane.normal, origin) + random.uniform(-0.5, 1.5);
        solid.sections.push_back(plane);
    }
    return solid;
}

/// What a pixel of a view of `solid` shows.
enum class Shown : std::uint8_t { Nothing, Side, Cap, Edge };

/// Of the middle of a pixel; Edge where its neighbours show something else, since the picture rounds outlines.
Shown shownAt(const SolidBox& solid, const plan::View& view, const glm::ivec2& pixel) {
    std::set<Shown> kinds;
    for (const glm::ivec2& aside : {glm::ivec2(0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const PixelLine line = lineOf(view, pixel + aside);
        const auto [from, to] = solid.inside(line);
        const bool isCap = solid.isOnCap(line.start + line.direction * from);
        kinds.insert(!(from < to) ? Shown::Nothing : isCap ? Shown::Cap : Shown::Side);
    }
    return kinds.size() == 1 ? *kinds.begin() : Shown::Edge;
}

TEST(DrawnPoint, OfASolidIsOnItsSidesAndOnItsCaps) {
    Random random(13);
    const glm::dvec3 origin(500000, 300, 5200000);
    std::map<Shown, int> counts;
    for (int round = 0; round < 24; ++round) {
        const SolidBox solid = randomBox(random, origin, round);
        tests::SceneMesh mesh(origin);
        mesh.addBox(solid.box.min - origin, solid.box.max - origin);
        DrawnModel model(mesh.model());
        const plan::View view = viewOfBox(random, solid, round);
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Off;
        const Frame frame = model.draw(view, quality);
        const hierarchy::Grid& grid = model.file().summary().grid;
        for (int i = 0; i < 250; ++i) {
            const glm::ivec2 pixel = randomPixel(random);
            const Shown shown = shownAt(solid, view, pixel);
            ++counts[shown];
            const auto found = drawnPoint(model.renderer(), frame, {}, pixel);
            if (shown == Shown::Edge) continue;
            ASSERT_EQ(found.has_value(), shown != Shown::Nothing) << round << ", " << pixel.x << ", " << pixel.y;
            if (!found) continue;
            ASSERT_EQ(found->vertex.has_value(), shown == Shown::Side) << round << ", " << pixel.x << ", " << pixel.y;
            const PixelLine line = lineOf(view, pixel);
            const glm::dvec3 expected = line.start + line.direction * solid.inside(line)[0];
            ASSERT_LE(glm::distance(inspect::worldOf(grid, found->point.cell), expected), 0.9 * grid.step());
        }
    }
    EXPECT_GT(counts[Shown::Side], 500);
    EXPECT_GT(counts[Shown::Cap], 60);
    EXPECT_GT(counts[Shown::Nothing], 1000);
}

} // namespace
} // namespace gnomon::frame
