#include "executor/view/section_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::executor {

namespace {

/// A point on the way from `a` to `b` where a plane is met, at the distances from it; the same for both directions.
glm::i64vec3 crossing(glm::i64vec3 a, double atA, glm::i64vec3 b, double atB) {
    const bool isTurned = std::array{b.x, b.y, b.z} < std::array{a.x, a.y, a.z};
    if (isTurned) {
        std::swap(a, b);
        std::swap(atA, atB);
    }
    const glm::dvec3 from(a);
    const glm::i64vec3 met(glm::round(from + (glm::dvec3(b) - from) * (atA / (atA - atB))));
    return met;
}

} // namespace

std::vector<Plane> sectionPlanes(const FrameDrawing& frame) {
    std::vector<Plane> planes;
    const glm::dvec3 origin = frame.grid.world(frame.space.originCell);
    for (const Plane& plane : frame.plan->view.sections)
        planes.push_back({plane.normal, plane.signedDistance(origin) / frame.space.step});
    return planes;
}

void SectionCut::reset(const FrameDrawing& frame) {
    planes_ = sectionPlanes(frame);
    origin_ = frame.space.originCell;
    pieces_.clear();
}

SectionCut::Cell SectionCut::cellOf(const hierarchy::GridPoint& point) const {
    const auto from = [](std::uint32_t a, std::uint32_t b) {
        return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
    };
    return {from(point.x, origin_.x), from(point.y, origin_.y), from(point.z, origin_.z)};
}

Containment SectionCut::place(const hierarchy::GridBox& box) const {
    const Box cells{glm::dvec3(cellOf(box.min)), glm::dvec3(cellOf(box.max))};
    return classify(ConvexVolume{planes_}, cells);
}

std::vector<SectionCut::Cell> SectionCut::kept(std::array<Cell, 3> corners) const {
    std::vector<Cell> polygon(corners.begin(), corners.end());
    for (const Plane& plane : planes_) {
        std::vector<Cell> rest;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Cell& a = polygon[i];
            const Cell& b = polygon[(i + 1) % polygon.size()];
            const double atA = plane.signedDistance(glm::dvec3(a));
            const double atB = plane.signedDistance(glm::dvec3(b));
            if (atA >= 0) rest.push_back(a);
            if ((atA >= 0) != (atB >= 0)) rest.push_back(crossing(a, atA, b, atB));
        }
        polygon = std::move(rest);
        if (polygon.size() < 3) return {};
    }
    return polygon;
}

void SectionCut::flush(
    const DrawnCluster& whole,
    const Pieces& pieces,
    std::vector<raster::Cluster>& clusters,
    std::vector<DrawnCluster>& drawn) {
    if (pieces.triangles.empty()) return;
    clusters.push_back(
        {pieces.positions.front().data(),
         sizeof(pieces.positions.front()),
         static_cast<std::uint32_t>(pieces.positions.size()),
         pieces.triangles,
         static_cast<std::uint32_t>(clusters.size()) << kTriangleBits});
    drawn.push_back(whole);
    drawn.back().triangles = pieces.wholes.data();
    drawn.back().isPiece = true;
}

void SectionCut::addPieces(
    const DrawnCluster& whole, std::vector<raster::Cluster>& clusters, std::vector<DrawnCluster>& drawn) {
    const hierarchy::Cluster& cluster = whole.page->clusters[whole.cluster];
    Pieces* pieces = &pieces_.emplace_back();
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        const hierarchy::Triangle& triangle = whole.triangles[t];
        std::array<Cell, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k)
            corners.at(k) = cellOf(whole.vertices[triangle.at(k)].position);
        const std::vector<Cell> polygon = kept(corners);
        if (polygon.empty()) continue;
        const bool isFull = pieces->positions.size() + polygon.size() > raster::kMaxClusterVertices ||
                            pieces->triangles.size() + polygon.size() - 2 > raster::kMaxClusterTriangles;
        if (isFull) {
            flush(whole, *pieces, clusters, drawn);
            pieces = &pieces_.emplace_back();
        }
        const auto first = static_cast<std::uint8_t>(pieces->positions.size());
        for (const Cell& cell : polygon)
            pieces->positions.push_back(
                {static_cast<std::uint32_t>(cell.x + origin_.x),
                 static_cast<std::uint32_t>(cell.y + origin_.y),
                 static_cast<std::uint32_t>(cell.z + origin_.z)});
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            const auto at = [&](std::size_t place) { return static_cast<std::uint8_t>(first + place); };
            pieces->triangles.push_back({at(0), at(i - 1), at(i)});
            pieces->wholes.push_back(triangle);
        }
    }
    flush(whole, *pieces, clusters, drawn);
}

} // namespace gnomon::executor
