#include "preprocess/verify/source_soup.h"

#include "core/error.h"
#include "preprocess/read/polygon.h"

#include <cmath>

namespace gnomon::verify {

namespace {

/// Returns the grid point nearest to a position in local space, as floating-point numbers.
glm::dvec3 snapped(const glm::dvec3& local, const hierarchy::Grid& grid) {
    return glm::floor(local / grid.step() + 0.5);
}

bool isOnGrid(const glm::dvec3& point) {
    constexpr auto kMax = static_cast<double>(hierarchy::kMaxGridCoordinate);
    return glm::all(glm::greaterThanEqual(point, glm::dvec3(0))) &&
           glm::all(glm::lessThanEqual(point, glm::dvec3(kMax)));
}

} // namespace

TriangleSoup readSoup(read::MeshSource& source, const hierarchy::Grid& grid, Progress& progress) {
    TriangleSoup soup;
    source.readVertices([&](const read::VertexBlock& block) {
        if (soup.positions.size() + block.positions.size() > 0xFFFFFFFFU)
            throw Error(
                source.summary().path,
                "too many vertices for a comparison",
                "at most 4294967295",
                std::to_string(source.summary().vertexCount));
        for (const glm::dvec3& position : block.positions)
            soup.positions.push_back(position - grid.origin);
        progress.advance(0); // lets the user interrupt the reading; vertices do not count as progress
    });
    read::PolygonRefiner refiner(progress);
    std::vector<read::TriangleCorners> triangles;
    source.readTriangles([&](const read::TriangleBlock& block) {
        triangles.assign(block.triangles.begin(), block.triangles.end());
        for (const read::PolygonRun& run : block.polygons)
            refiner.refine(std::span(triangles).subspan(run.first, run.count), [&soup](std::uint64_t vertex) {
                return soup.positions[vertex];
            });
        for (const read::TriangleCorners& t : triangles) {
            for (const std::uint64_t corner : t)
                read::requireFinite(source, corner, soup.positions[corner]);
            const glm::dvec3 a = snapped(soup.positions[t[0]], grid);
            const glm::dvec3 b = snapped(soup.positions[t[1]], grid);
            const glm::dvec3 c = snapped(soup.positions[t[2]], grid);
            if (a == b || b == c || c == a || !isOnGrid(a) || !isOnGrid(b) || !isOnGrid(c)) continue;
            soup.triangles.push_back(
                {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2])});
        }
        progress.advance(block.triangles.size());
    });
    source.requireUnchanged();
    return soup;
}

} // namespace gnomon::verify
