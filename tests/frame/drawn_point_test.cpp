// The point of a triangle that is seen at a pixel: against every triangle that was drawn, and against the source.
#include "core/random.h"
#include "frame/drawn_model.h"
#include "frame/drawn_point.h"
#include "survey/cells.h"

#include <gtest/gtest.h>

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
    for (const selection::ClusterRange& range : frame.cut.lists[0].ranges)
        for (std::uint32_t i = 0; i < range.clusterCount; ++i)
            addTriangles(
                *resident[range.page],
                resident[range.page]->clusters[range.firstCluster + i],
                model.file().summary().grid,
                all);
    return all;
}

/// The first point of `triangles` on a line, by solving three equations a triangle; nothing before `least`.
std::optional<glm::dvec3> firstOn(
    const std::vector<Corners>& triangles, const glm::dvec3& start, const glm::dvec3& direction, double least) {
    std::optional<double> first;
    for (const Corners& t : triangles) {
        const glm::dmat3 equations(t[1] - t[0], t[2] - t[0], -direction);
        if (glm::determinant(equations) == 0) continue;
        const glm::dvec3 solved = glm::inverse(equations) * (start - t[0]);
        const bool isInside = solved.x >= -1e-12 && solved.y >= -1e-12 && solved.x + solved.y <= 1 + 1e-12;
        if (isInside && solved.z > least && solved.z < first.value_or(1e300)) first = solved.z;
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
double leastSeen(const plan::View& view, const PixelLine& line) {
    double least = view.camera.isParallel() ? -1e9 : 0;
    for (const Plane& plane : view.sections) {
        const double along = glm::dot(plane.normal, line.direction);
        if (along > 0) least = std::max(least, -plane.signedDistance(line.start) / along);
    }
    return least;
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

    glm::dvec3 world(const GridPlace& place) const { return survey::worldOf(hills_.summary.grid, place.cell); }

    std::optional<DrawnPoint> at(const glm::ivec2& pixel) { return drawnPoint(model_.renderer(), frame_, {}, pixel); }

    std::optional<glm::dvec3> expectedAt(const glm::ivec2& pixel) const {
        const PixelLine line = lineOf(view_, pixel);
        const auto first = firstOn(triangles_, line.start, line.direction, leastSeen(view_, line));
        for (const Plane& plane : view_.sections)
            if (first && plane.signedDistance(*first) < 0) return std::nullopt;
        return first;
    }

    /// Whether the picture, which rounds to its own places within a pixel, shows something else than `point` there.
    bool isDrawnElsewhere(const glm::ivec2& pixel, const glm::dvec3& point) {
        const double depth = glm::dot(point - view_.camera.eye, cameraBasis(view_.camera).view);
        return std::abs(model_.executor().viewDepth().at(pixel.x, pixel.y) - depth) > 0.01 * std::abs(depth);
    }

    /// How far `point` is from the section of the view, which has one.
    double toSection(const glm::dvec3& point) const { return std::abs(view_.sections.at(0).signedDistance(point)); }

    bool isDrawnVertex(const glm::i64vec3& cell) const {
        const glm::dvec3 world = survey::worldOf(hills_.summary.grid, cell);
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
    double most = 0;
    for (std::uint64_t round = 0; round < 4; ++round) {
        DrawnHills drawn(round + 31, random, 0, 4);
        const std::vector<Corners> source = sourceTriangles(drawn.source());
        const auto expectNear = [&](const GridPlace& place) {
            const glm::dvec3 at = drawn.world(place);
            const auto below = firstOn(source, at + glm::dvec3(0, 1000, 0), {0, -1, 0}, 0);
            if (!below) return; // the rounding took it over the edge
            EXPECT_LE(std::abs(below->y - at.y), place.within + 1e-6);
            most = std::max(most, std::abs(below->y - at.y) / place.within);
        };
        for (int i = 0; i < 60; ++i)
            if (const auto found = drawn.at(randomPixel(random))) {
                expectNear(found->point);
                expectNear(*found->vertex);
            }
    }
    EXPECT_GT(most, 0.3); // else the bound says little
}

} // namespace
} // namespace gnomon::frame
