// What sections leave of clusters, triangle by triangle, against plain clipping; their lines against plain meetings.
#include "core/random.h"
#include "render/view/grid_polygon.h"
#include "render/view/section_memory.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

namespace gnomon::render {
namespace {

using PlainTriangle = std::array<glm::dvec3, 3>;

/// A page of one cluster of triangles between random points of the grid.
hierarchy::Page randomPage(Random& random, std::uint32_t vertices, std::uint32_t triangles) {
    hierarchy::Page page;
    hierarchy::Cluster cluster;
    const auto coordinate = [&] { return static_cast<std::uint32_t>(1000 + random.below(4000)); };
    for (std::uint32_t v = 0; v < vertices; ++v) {
        hierarchy::Vertex vertex;
        vertex.position = {coordinate(), coordinate(), coordinate()};
        cluster.box.add(vertex.position);
        page.vertices.push_back(vertex);
    }
    const auto corner = [&] { return static_cast<std::uint8_t>(random.below(vertices)); };
    while (page.triangles.size() < triangles) {
        const hierarchy::Triangle triangle{corner(), corner(), corner()};
        const bool isFlat = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2];
        if (!isFlat) page.triangles.push_back(triangle);
    }
    cluster.vertexCount = vertices;
    cluster.triangleCount = triangles;
    page.clusters.push_back(cluster);
    return page;
}

/// A frame of one page with sections through the middle of its points.
class CutStage {
public:
    CutStage(hierarchy::Page page, std::vector<Plane> planes) : page_(std::move(page)) {
        plan_.view.sections = std::move(planes);
        drawing_.plan = &plan_;
        drawing_.space.step = 1;
        drawing_.pages = [this](std::uint32_t) -> const hierarchy::Page& { return page_; };
        drawing_.sectionMemory = &memory_;
        list_.ranges = {{0, 0, 1}};
        drawing_.sections.assign(plan_.view.sections.size(), &list_);
        memory_.cut.begin(drawing_);
    }

    void cut() {
        memory_.cut.cut(drawing_, list_.ranges);
        memory_.cut.addPieces(drawnCluster(page_, 0, 0), clusters_, drawn_);
    }

    const std::vector<SectionLine>& lines(std::size_t plane) {
        memory_.lines.find(drawing_);
        return memory_.lines.of(plane);
    }

    const hierarchy::Page& page() const { return page_; }

    const std::vector<Plane>& planes() const { return plan_.view.sections; }

    const std::vector<raster::Cluster>& clusters() const { return clusters_; }

    const std::vector<DrawnCluster>& drawn() const { return drawn_; }

    PlainTriangle corners(const hierarchy::Triangle& triangle) const {
        PlainTriangle result{};
        for (std::size_t k = 0; k < 3; ++k)
            result.at(k) = gridCellOf(page_.vertices[triangle.at(k)].position);
        return result;
    }

private:
    hierarchy::Page page_;
    plan::FramePlan plan_;
    DrawInputs drawing_;
    lod::DrawList list_;
    SectionMemory memory_;
    std::vector<raster::Cluster> clusters_;
    std::vector<DrawnCluster> drawn_;
};

Plane randomPlane(Random& random) {
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    const glm::dvec3 point(random.uniform(2000, 4000), random.uniform(2000, 4000), random.uniform(2000, 4000));
    return {normal, -glm::dot(normal, point)};
}

CutStage randomStage(Random& random, std::uint32_t vertices, std::uint32_t triangles) {
    std::vector<Plane> planes;
    for (std::uint64_t i = 0; i <= random.below(3); ++i)
        planes.push_back(randomPlane(random));
    return {randomPage(random, vertices, triangles), planes};
}

/// The area that planes leave of a triangle, by Sutherland and Hodgman without any rounding.
double keptArea(const PlainTriangle& triangle, const std::vector<Plane>& planes) {
    std::vector<glm::dvec3> polygon(triangle.begin(), triangle.end());
    for (const Plane& plane : planes) {
        std::vector<glm::dvec3> rest;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec3 a = polygon[i];
            const glm::dvec3 b = polygon[(i + 1) % polygon.size()];
            const double atA = plane.signedDistance(a);
            const double atB = plane.signedDistance(b);
            if (atA >= 0) rest.push_back(a);
            if ((atA >= 0) != (atB >= 0)) rest.push_back(a + (b - a) * (atA / (atA - atB)));
        }
        polygon = rest;
    }
    glm::dvec3 area(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        area += 0.5 * glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return glm::length(area);
}

/// The corners of a triangle of a cluster that is drawn.
PlainTriangle drawnCorners(const raster::Cluster& cluster, std::size_t triangle) {
    PlainTriangle result{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = cluster.triangles[triangle].at(k);
        EXPECT_LT(vertex, cluster.vertexCount);
        const std::uint32_t* p = cluster.positions + vertex * (cluster.positionStride / sizeof(std::uint32_t));
        result.at(k) = {p[0], p[1], p[2]};
    }
    return result;
}

double areaOf(const PlainTriangle& t) {
    return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

TEST(SectionCut, LeavesOfEachTriangleWhatPlainClippingLeaves) {
    Random random(21);
    for (int trial = 0; trial < 60; ++trial) {
        CutStage stage = randomStage(random, 40, 100);
        stage.cut();
        std::map<hierarchy::Triangle, double> found;
        std::map<hierarchy::Triangle, int> times;
        for (const hierarchy::Triangle& triangle : stage.page().triangles)
            ++times[triangle];
        for (std::size_t c = 0; c < stage.clusters().size(); ++c) {
            const raster::Cluster& cluster = stage.clusters()[c];
            EXPECT_TRUE(stage.drawn()[c].isPiece);
            for (std::size_t t = 0; t < cluster.triangles.size(); ++t) {
                const PlainTriangle corners = drawnCorners(cluster, t);
                found[stage.drawn()[c].triangles[t]] += areaOf(corners);
                for (const glm::dvec3& corner : corners)
                    for (const Plane& plane : stage.planes())
                        EXPECT_GT(plane.signedDistance(corner), -1.0) << "but for the rounding";
            }
        }
        for (const auto& [triangle, count] : times) {
            const PlainTriangle corners = stage.corners(triangle);
            const double around = glm::length(corners[1] - corners[0]) + glm::length(corners[2] - corners[1]) +
                                  glm::length(corners[0] - corners[2]);
            EXPECT_NEAR(found[triangle], count * keptArea(corners, stage.planes()), count * around) << trial;
        }
    }
}

TEST(SectionCut, KeepsToWhatAClusterCanHoldAndNamesItByPlace) {
    Random random(22);
    std::size_t parts = 0;
    for (int trial = 0; trial < 20; ++trial) {
        CutStage stage = randomStage(random, raster::kMaxClusterVertices, raster::kMaxClusterTriangles);
        stage.cut();
        parts = std::max(parts, stage.clusters().size());
        for (std::size_t c = 0; c < stage.clusters().size(); ++c) {
            const raster::Cluster& cluster = stage.clusters()[c];
            EXPECT_EQ(cluster.firstTriangleId, c << kTriangleBits);
            EXPECT_LE(cluster.vertexCount, raster::kMaxClusterVertices);
            EXPECT_LE(cluster.triangles.size(), raster::kMaxClusterTriangles);
            EXPECT_FALSE(cluster.triangles.empty());
        }
    }
    EXPECT_GT(parts, 2U);
}

/// How long the line is in which a plane meets a triangle.
double metLength(const PlainTriangle& corners, const Plane& plane) {
    std::vector<glm::dvec3> ends;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& next = corners.at((k + 1) % 3);
        const double a = plane.signedDistance(corners.at(k));
        const double b = plane.signedDistance(next);
        if ((a >= 0) != (b >= 0)) ends.push_back(glm::mix(corners.at(k), next, a / (a - b)));
    }
    return ends.size() == 2 ? glm::length(ends[1] - ends[0]) : 0;
}

TEST(SectionCut, LinesAreThoseInWhichThePlaneMeetsTriangles) {
    Random random(23);
    for (int trial = 0; trial < 60; ++trial) {
        CutStage stage = randomStage(random, 30, 60);
        for (std::size_t plane = 0; plane < stage.planes().size(); ++plane) {
            const Plane& cut = stage.planes()[plane];
            double wanted = 0;
            for (const hierarchy::Triangle& triangle : stage.page().triangles)
                wanted += metLength(stage.corners(triangle), cut);
            double found = 0;
            for (const SectionLine& line : stage.lines(plane)) {
                EXPECT_NEAR(cut.signedDistance(line.from), 0, 10) << "but for bridges, which join ends a little apart";
                found += glm::length(line.to - line.from);
            }
            EXPECT_NEAR(found, wanted, 1e-3 * wanted + 1) << trial;
        }
    }
}

} // namespace
} // namespace gnomon::render
