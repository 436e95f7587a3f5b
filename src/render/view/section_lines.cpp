#include "render/view/section_lines.h"

#include "render/view/grid_polygon.h"
#include "render/view/section_cut.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

namespace gnomon::render {

namespace {

/// Returns the intersection of the edge from `a` to `b` with a plane. `atA` and `atB` are the signed distances of the
/// ends from the plane. The result is the same for both directions of the edge.
glm::dvec3 meeting(glm::dvec3 a, double atA, glm::dvec3 b, double atB) {
    const bool isTurned = std::array{b.x, b.y, b.z} < std::array{a.x, a.y, a.z};
    if (isTurned) {
        std::swap(a, b);
        std::swap(atA, atB);
    }
    return a + (b - a) * (atA / (atA - atB));
}

/// Returns true if the distance between plane and box is at most one cell.
bool isHit(const hierarchy::GridBox& box, const Plane& plane) {
    const glm::dvec3 half = (gridCellOf(box.max) - gridCellOf(box.min)) * 0.5;
    return std::abs(plane.signedDistance(gridCellOf(box.min) + half)) <= glm::dot(glm::abs(plane.normal), half) + 1;
}

/// Returns the intersection lines of `plane` with the triangles of a cluster.
std::vector<SectionLine> linesIn(const hierarchy::Page& page, const hierarchy::Cluster& cluster, const Plane& plane) {
    const auto placeOf = [&](std::size_t v) { return gridCellOf(page.vertices[cluster.firstVertex + v].position); };
    std::array<double, raster::kMaxClusterVertices> sides{};
    for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
        sides.at(v) = plane.signedDistance(placeOf(v));
    std::vector<SectionLine> lines;
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        const hierarchy::Triangle& corners = page.triangles[cluster.firstTriangle + t];
        const int kept = static_cast<int>(sides.at(corners[0]) >= 0) + static_cast<int>(sides.at(corners[1]) >= 0) +
                         static_cast<int>(sides.at(corners[2]) >= 0);
        if (kept == 0 || kept == 3) continue;
        SectionLine& line = lines.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t a = corners[i];
            const std::size_t b = corners[(i + 1) % 3];
            if ((sides.at(a) >= 0) == (sides.at(b) >= 0)) continue;
            // The corners are counter-clockwise as seen from outside the solid. The outline of a triangle crosses the
            // plane twice, once in each direction.
            (sides.at(a) >= 0 ? line.from : line.to) = meeting(placeOf(a), sides.at(a), placeOf(b), sides.at(b));
        }
    }
    return lines;
}

} // namespace

/// Computes the intersection lines of clusters that are not in the cache `held`. Then concatenates the lines of all
/// clusters.
void SectionLines::gather(const DrawInputs& frame, Held& held) {
    std::vector<const std::vector<SectionLine>*> parts;
    std::vector<std::pair<ClusterName, std::vector<SectionLine>*>> missing;
    std::size_t size = 0;
    for (const lod::ClusterRange& range : held.ranges) {
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (!isHit(page.clusters[c].box, held.plane)) continue;
            const auto [place, isNew] = held.ofClusters.try_emplace(std::uint64_t{range.page} << 32U | c);
            parts.push_back(&place->second);
            if (isNew) missing.push_back({{&page, c}, &place->second});
        }
    }
    tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t i) {
        const auto& [page, cluster] = missing[i].first;
        *missing[i].second = linesIn(*page, page->clusters[cluster], held.plane);
    });
    for (const std::vector<SectionLine>* part : parts)
        size += part->size();
    held.lines.clear();
    held.lines.reserve(size);
    for (const std::vector<SectionLine>* part : parts)
        held.lines.insert(held.lines.end(), part->begin(), part->end());
    for (const auto& [name, lines] : missing)
        held.known += lines->size();
    constexpr std::size_t kMaxKnownLines = std::size_t{1} << 18U; // max number of cached lines; they need 14 MiB
    if (held.known <= kMaxKnownLines) return;
    held.ofClusters.clear();
    held.known = 0;
}

void SectionLines::find(const DrawInputs& frame) {
    const std::vector<Plane> planes = sectionPlanesOfGrid(frame);
    held_.resize(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        Held& held = held_[i];
        const std::vector<lod::ClusterRange>& ranges = frame.sections[i]->ranges;
        const bool isSamePlane = held.plane.normal == planes[i].normal && held.plane.offset == planes[i].offset;
        if (isSamePlane && held.ranges == ranges) continue;
        if (!isSamePlane) held = {planes[i], {}, {}, {}, 0};
        held.ranges = ranges;
        gather(frame, held);
        markClosed(held.lines);
    }
}

} // namespace gnomon::render
