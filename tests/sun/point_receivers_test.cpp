// Points anywhere in a model before its casters, and before what sections leave of these.
#include "core/error.h"
#include "exact/predicate.h"
#include "inspect/cells.h"
#include "render/exact_pass.h"
#include "sun/point_receivers.h"
#include "sun/sectioned_cut.h"
#include "tests/sun/box_yard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace gnomon::sun {
namespace {

/// Where the line from `point` along `light` meets the plane of `corners`, which are relative to it.
glm::dvec3 hitPlace(const exact::Corners& corners, const glm::i64vec3& point, const IntegerLight& light) {
    const glm::dvec3 a(corners[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
    const glm::dvec3 way = light.unit();
    return glm::dvec3(point) + way * (glm::dot(a, normal) / glm::dot(way, normal));
}

/// Whether no triangle of `cut` by itself stands ahead of a point, in integers, where `sections` leave it.
bool isLitPlainly(
    const exporter::UniformCut& cut,
    const glm::i64vec3& point,
    const IntegerLight& light,
    const std::vector<Plane>& sections = {}) {
    const auto& vertices = cut.mesh.vertices;
    for (const auto& triangle : cut.mesh.triangles) {
        exact::Corners corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const hierarchy::GridPoint& p = vertices[triangle[k]].position;
            corners[k] = glm::i64vec3(p.x, p.y, p.z) - point;
        }
        if (exact::intersect(corners, light, glm::i64vec3(0), render::tolerance(light)).kind != exact::Hit::Ahead)
            continue;
        const bool isKept = std::all_of(sections.begin(), sections.end(), [&](const Plane& plane) {
            return plane.signedDistance(hitPlace(corners, point, light)) >= 0;
        });
        if (isKept) return false;
    }
    return true;
}

TEST(PointReceivers, AreLitUnlessATriangleByItselfStandsAhead) {
    std::size_t dark = 0;
    std::size_t lit = 0;
    for (const std::uint64_t seed : {21U, 22U}) {
        BoxYard yard(seed);
        const hierarchy::ModelFile& file = yard.model->file();
        const hierarchy::Grid& grid = file.summary().grid;
        NoProgress silent;
        exporter::ExportLimit limit;
        limit.error = grid.snapError();
        const exporter::UniformCut cut = exporter::uniformCut(file, limit, silent);
        std::vector<glm::i64vec3> points;
        for (const hierarchy::Vertex& vertex : cut.mesh.vertices)
            points.emplace_back(vertex.position.x, vertex.position.y, vertex.position.z);
        for (int i = 0; i < 300; ++i) // some beside the grid, some where no cell is
            points.push_back(inspect::cellOf(
                grid, {yard.random.uniform(-30, 30), yard.random.uniform(-3, 12), yard.random.uniform(-30, 30)}));
        PointReceivers receivers(cut, points);
        ASSERT_EQ(receivers.count(), points.size());
        std::vector<std::uint8_t> isLit(points.size());
        std::vector<std::uint8_t> isTrulyLit(points.size());
        std::vector<std::uint8_t> isRequested(points.size());
        for (std::size_t i = 0; i < points.size(); i += 3)
            isRequested[i] = 1;
        for (const IntegerLight& light : yard.lights) {
            receivers.resolve(light, isLit);
            receivers.resolvePlainly(light, isRequested, isTrulyLit);
            for (std::size_t i = 0; i < points.size(); ++i)
                ASSERT_EQ(isTrulyLit[i], isRequested[i] != 0 ? isLit[i] : 0) << "seed " << seed << ", point " << i;
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(isLit[i] != 0, isLitPlainly(cut, points[i], light)) << "seed " << seed << ", point " << i;
                ++(isLit[i] != 0 ? lit : dark);
            }
        }
    }
    EXPECT_GT(dark, 500U);
    EXPECT_GT(lit, 500U);
}

/// The finest cut of a model.
exporter::UniformCut finestCut(const hierarchy::ModelFile& file) {
    NoProgress silent;
    exporter::ExportLimit limit;
    limit.error = file.summary().grid.snapError();
    return exporter::uniformCut(file, limit, silent);
}

TEST(PointReceivers, SeePastWhatSectionsCutAway) {
    BoxYard yard(23);
    const hierarchy::Grid& grid = yard.model->file().summary().grid;
    const exporter::UniformCut cut = finestCut(yard.model->file());
    std::vector<glm::i64vec3> points;
    points.reserve(600);
    for (int i = 0; i < 600; ++i)
        points.push_back(inspect::cellOf(
            grid, {yard.random.uniform(-12, 12), yard.random.uniform(-1, 3), yard.random.uniform(-12, 12)}));
    std::vector<Plane> sections;
    for (const Plane& plane : {Plane{{0, -1, 0}, 2.5}, Plane{{-0.8, 0, 0.6}, 6}})
        sections.push_back({plane.normal, plane.signedDistance(grid.origin) / grid.step()});
    PointReceivers whole(cut, points);
    PointReceivers receivers(cut, points, sections);
    std::vector<std::uint8_t> isLit(points.size());
    std::vector<std::uint8_t> isLitByWhole(points.size());
    std::size_t unlike = 0;
    std::size_t changed = 0;
    for (const IntegerLight& light : yard.lights) {
        receivers.resolve(light, isLit);
        whole.resolve(light, isLitByWhole);
        for (std::size_t i = 0; i < points.size(); ++i) {
            unlike += (isLit[i] != 0) != isLitPlainly(cut, points[i], light, sections) ? 1 : 0;
            changed += isLit[i] != isLitByWhole[i] ? 1 : 0;
        }
    }
    EXPECT_LE(unlike, 2U) << "corners of pieces are rounded";
    EXPECT_GT(changed, 100U);
    const Plane nothing{{0, -1, 0}, -1e9};
    PointReceivers open(cut, points, std::array{nothing});
    open.resolve(yard.lights.front(), isLit);
    EXPECT_EQ(std::count(isLit.begin(), isLit.end(), 1), static_cast<std::ptrdiff_t>(points.size()));
}

TEST(PointReceivers, RefuseWhatIsTooFarAway) {
    BoxYard yard(1);
    const hierarchy::Grid& grid = yard.model->file().summary().grid;
    const exporter::UniformCut cut = finestCut(yard.model->file());
    EXPECT_THROW(PointReceivers(cut, {inspect::cellOf(grid, {0, 1e300, 0})}), Error);
    EXPECT_EQ(inspect::cellOf(grid, grid.world({5, 6, 7}) + glm::dvec3(0.4 * grid.step())), glm::i64vec3(5, 6, 7));
}

/// Twice the area of all triangles, cells, of those parts that lie on the inner side of `planes`.
double keptArea(const exporter::UniformCut& cut, const std::vector<Plane>& planes) {
    double area = 0;
    for (const exporter::CutCluster& cluster : sectionedCut(cut, planes).clusters) {
        EXPECT_LE(cluster.vertexCount, raster::kMaxClusterVertices);
        EXPECT_LE(cluster.triangleCount, raster::kMaxClusterTriangles);
    }
    const exporter::UniformCut kept = sectionedCut(cut, planes);
    for (const auto& triangle : kept.mesh.triangles) {
        std::array<glm::dvec3, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) {
            const hierarchy::GridPoint& at = kept.mesh.vertices.at(triangle[k]).position;
            p.at(k) = {at.x, at.y, at.z};
            for (const Plane& plane : planes)
                EXPECT_GE(plane.signedDistance(p.at(k)), -1) << "but for rounding";
        }
        area += glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    return area;
}

TEST(SectionedCut, PartsWhatThereIsIntoWhatLiesOnEitherSide) {
    BoxYard yard(24);
    const exporter::UniformCut cut = finestCut(yard.model->file());
    const double whole = keptArea(cut, {});
    for (int trial = 0; trial < 12; ++trial) {
        const glm::dvec3 normal = glm::normalize(
            glm::dvec3(yard.random.uniform(-1, 1), yard.random.uniform(-1, 1), yard.random.uniform(-1, 1)));
        const hierarchy::GridPoint& middle = cut.mesh.vertices[yard.random.below(cut.mesh.vertices.size())].position;
        const Plane plane{normal, -glm::dot(normal, glm::dvec3(middle.x, middle.y, middle.z))};
        const double parts = keptArea(cut, {plane}) + keptArea(cut, {{-plane.normal, -plane.offset}});
        EXPECT_NEAR(parts / whole, 1, 1e-3);
    }
}

} // namespace
} // namespace gnomon::sun
