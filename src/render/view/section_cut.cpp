#include "render/view/section_cut.h"

#include "core/check.h"
#include "render/view/grid_polygon.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon::render {

namespace {

std::uint64_t keyOf(const DrawnCluster& drawn) {
    return std::uint64_t{drawn.pageId} << 32U | drawn.cluster;
}

std::vector<Plane> planesFrom(const DrawInputs& frame, const glm::dvec3& origin) {
    std::vector<Plane> planes;
    for (const Plane& plane : frame.plan->view.sections)
        planes.push_back({plane.normal, plane.signedDistance(origin) / frame.space.step});
    return planes;
}

} // namespace

std::vector<Plane> sectionPlanes(const DrawInputs& frame) {
    return planesFrom(frame, frame.grid.world(frame.space.originCell));
}

std::vector<Plane> sectionPlanesOfGrid(const DrawInputs& frame) {
    return planesFrom(frame, frame.grid.origin);
}

void SectionCut::begin(const DrawInputs& frame) {
    constexpr std::size_t kMaxBytes = std::size_t{32} << 20U;
    const auto isSame = [](const Plane& a, const Plane& b) { return a.normal == b.normal && a.offset == b.offset; };
    std::vector<Plane> planes = sectionPlanesOfGrid(frame);
    GNOMON_CHECK(planes.size() <= kMaxSections);
    const bool areSame = std::equal(planes.begin(), planes.end(), planes_.begin(), planes_.end(), isSame);
    planes_ = std::move(planes);
    if (areSame && bytes_ <= kMaxBytes) return;
    cuts_.clear();
    bytes_ = 0;
}

Containment SectionCut::place(const hierarchy::GridBox& box) const {
    const glm::dvec3 center = (gridCellOf(box.min) + gridCellOf(box.max)) * 0.5;
    const glm::dvec3 half = (gridCellOf(box.max) - gridCellOf(box.min)) * 0.5;
    Containment result = Containment::Inside;
    for (const Plane& plane : planes_) {
        const double reach = glm::dot(glm::abs(plane.normal), half);
        const double middle = plane.signedDistance(center);
        if (middle < -reach) return Containment::Outside;
        if (middle < reach) result = Containment::Intersecting;
    }
    return result;
}

/// Adds an empty entry for the cluster `whole` to the cache and returns it. Returns null if the cache already contains
/// the cluster.
SectionCut::CutCluster* SectionCut::insert(const DrawnCluster& whole) {
    const auto [place, isNew] = cuts_.try_emplace(keyOf(whole));
    return isNew ? &place->second : nullptr;
}

std::size_t SectionCut::bytesOf(const CutCluster& cut) {
    const auto sizeOf = [](const auto& all) { return all.capacity() * sizeof(all.front()); };
    return sizeof(CutCluster) + sizeOf(cut.untouched) + sizeOf(cut.positions) + sizeOf(cut.triangles) +
           sizeOf(cut.wholes) + sizeOf(cut.parts);
}

void SectionCut::cut(const DrawInputs& frame, std::span<const lod::ClusterRange> ranges) {
    std::vector<std::pair<DrawnCluster, CutCluster*>> work;
    for (const lod::ClusterRange& range : ranges) {
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (place(page.clusters[c].box) != Containment::Intersecting) continue;
            const DrawnCluster whole = drawnCluster(page, range.page, c);
            if (CutCluster* cut = insert(whole)) work.emplace_back(whole, cut);
        }
    }
    tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t i) { cutCluster(work[i].first, *work[i].second); });
    for (const auto& [whole, cut] : work)
        bytes_ += bytesOf(*cut);
}

/// Clips a triangle by section planes, and adds the result to `cut`. Each bit of `outside` is a plane that intersects
/// the triangle.
void SectionCut::cutTriangle(
    const DrawnCluster& whole, const hierarchy::Triangle& triangle, unsigned outside, CutCluster& cut) const {
    GridPolygon polygon;
    for (const std::uint8_t corner : triangle)
        polygon.add(gridCellOf(whole.vertices[corner].position));
    for (std::size_t plane = 0; plane < planes_.size(); ++plane)
        if ((outside >> plane & 1U) != 0) polygon = clipped(polygon, planes_[plane]);
    if (polygon.size < 3) return;
    const auto isFull = [&](const CutCluster::Part& part) {
        return cut.positions.size() - part.firstPosition + polygon.size > raster::kMaxClusterVertices ||
               cut.triangles.size() - part.firstTriangle + polygon.size - 2 > raster::kMaxClusterTriangles;
    };
    if (cut.parts.empty() || isFull(cut.parts.back()))
        cut.parts.push_back({cut.positions.size(), cut.triangles.size()});
    const std::size_t first = cut.positions.size() - cut.parts.back().firstPosition;
    const auto at = [&](std::size_t corner) { return static_cast<std::uint8_t>(first + corner); };
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const glm::u64vec3 p(polygon.corners.at(i));
        cut.positions.push_back(
            {static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y), static_cast<std::uint32_t>(p.z)});
    }
    for (std::size_t i = 2; i < polygon.size; ++i) {
        cut.triangles.push_back({at(0), at(i - 1), at(i)});
        cut.wholes.push_back(triangle);
    }
}

void SectionCut::cutCluster(const DrawnCluster& whole, CutCluster& cut) const {
    const hierarchy::Cluster& cluster = whole.page->clusters[whole.cluster];
    // For each vertex, one bit per section plane that removes the vertex.
    std::array<std::uint8_t, raster::kMaxClusterVertices> outside{};
    for (std::size_t plane = 0; plane < planes_.size(); ++plane)
        for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
            if (planes_[plane].signedDistance(gridCellOf(whole.vertices[v].position)) < 0)
                outside[v] |= static_cast<std::uint8_t>(1U << plane);
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        const hierarchy::Triangle& triangle = whole.triangles[t];
        const unsigned a = outside[triangle[0]];
        const unsigned b = outside[triangle[1]];
        const unsigned c = outside[triangle[2]];
        if ((a & b & c) != 0) continue;
        if ((a | b | c) == 0)
            cut.untouched.push_back(triangle);
        else
            cutTriangle(whole, triangle, a | b | c, cut);
    }
}

void SectionCut::addPieces(
    const DrawnCluster& whole, std::vector<raster::Cluster>& clusters, std::vector<DrawnCluster>& drawn) {
    const CutCluster& cut = cuts_.at(keyOf(whole));
    const auto add = [&](raster::Cluster cluster, const hierarchy::Triangle* wholes) {
        cluster.firstTriangleId = static_cast<std::uint32_t>(clusters.size()) << kTriangleBits;
        clusters.push_back(cluster);
        drawn.push_back(whole);
        drawn.back().triangles = wholes;
        drawn.back().isPiece = true;
    };
    if (!cut.untouched.empty()) {
        const std::uint32_t vertexCount = whole.page->clusters[whole.cluster].vertexCount;
        add({&whole.vertices->position.x, sizeof(hierarchy::Vertex), vertexCount, cut.untouched, 0},
            cut.untouched.data());
    }
    for (std::size_t i = 0; i < cut.parts.size(); ++i) {
        const CutCluster::Part& part = cut.parts[i];
        const bool isLast = i + 1 == cut.parts.size();
        const std::size_t positions =
            (isLast ? cut.positions.size() : cut.parts[i + 1].firstPosition) - part.firstPosition;
        const std::size_t triangles =
            (isLast ? cut.triangles.size() : cut.parts[i + 1].firstTriangle) - part.firstTriangle;
        add({cut.positions[part.firstPosition].data(),
             sizeof(cut.positions.front()),
             static_cast<std::uint32_t>(positions),
             {&cut.triangles[part.firstTriangle], triangles},
             0},
            &cut.wholes[part.firstTriangle]);
    }
}

} // namespace gnomon::render
