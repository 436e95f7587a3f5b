#include "preprocess/simplify/cost_estimate.h"

#include "hierarchy/octahedral.h"

#include <algorithm>

namespace gnomon::simplify {

namespace {

constexpr double kBorderWeight = 2;    // weight of the squared length of an open edge, compared with face areas
constexpr double kCreaseWeight = 0.5;  // weight of the squared length of an edge between different normals or colours
constexpr double kLengthWeight = 1e-5; // weight of the squared length, so that short edges in flat areas collapse first
constexpr double kNormalWeight = 0.1;  // weight of the squared length times the squared change of the normal
constexpr double kColorWeight = 0.02;  // weight of the squared length times the squared change of the colour (0 to 1)

} // namespace

CostEstimate::CostEstimate(const Patch& patch, const SimplificationMesh& mesh)
    : patch_(patch), quadric_(patch.positions.size()) {
    addFacePlanes(mesh);
    addEdgePlanes(mesh);
    loadSites();
}

void CostEstimate::addFacePlanes(const SimplificationMesh& mesh) {
    for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t) {
        const glm::dvec3& normal = mesh.originalNormal(t);
        const double length = glm::length(normal);
        if (!(length > 0)) continue;
        const glm::dvec3& a = patch_.positions[mesh.positions(t)[0]];
        Quadric plane;
        plane.addPlane(normal / length, a, length * 0.5);
        for (const std::uint32_t p : mesh.positions(t))
            quadric_[p].add(plane);
    }
}

void CostEstimate::addEdgePlanes(const SimplificationMesh& mesh) {
    for (std::uint32_t corner = 0; corner < patch_.triangles.size() * 3; ++corner) {
        const EdgeKind kind = mesh.originalEdge(corner);
        if (kind == EdgeKind::Smooth) continue;
        const Triangle& t = mesh.positions(corner / 3);
        const std::uint32_t a = t[corner % 3];
        const std::uint32_t b = t[(corner % 3 + 1) % 3];
        const glm::dvec3 edge = patch_.positions[b] - patch_.positions[a];
        const glm::dvec3 upright = glm::cross(edge, mesh.originalNormal(corner / 3));
        const double length = glm::length(upright);
        if (!(length > 0)) continue;
        const double weight = proximity::squaredLength(edge) * (kind == EdgeKind::Open ? kBorderWeight : kCreaseWeight);
        Quadric plane;
        plane.addPlane(upright / length, patch_.positions[a], weight);
        quadric_[a].add(plane);
        quadric_[b].add(plane);
    }
}

void CostEstimate::loadSites() {
    weights_.length = kLengthWeight;
    for (const Vertex& vertex : patch_.vertices) {
        if (vertex.normal != hierarchy::kNoNormal) weights_.normal = kNormalWeight;
        if (vertex.color != patch_.vertices.front().color) weights_.color = kColorWeight;
    }
    const auto rowOf = [](const glm::dvec3& v) { return CostSite::Row{v.x, v.y, v.z, 0}; };
    sites_.resize(patch_.positions.size());
    for (std::size_t p = 0; p < sites_.size(); ++p)
        sites_[p].position = rowOf(patch_.positions[p]);
    // The reverse order lets the first vertex of each position overwrite the later vertices.
    for (std::size_t v = patch_.vertices.size(); v-- > 0;) {
        const Vertex& vertex = patch_.vertices[v];
        CostSite& site = sites_[patch_.positionOf[v]];
        if (weights_.normal > 0) site.normal = rowOf(hierarchy::unpackNormal(vertex.normal));
        if (weights_.color > 0)
            site.color = rowOf(
                glm::dvec3(vertex.color & 0xFFU, vertex.color >> 8U & 0xFFU, vertex.color >> 16U & 0xFFU) / 255.0);
    }
}

std::span<const double> CostEstimate::squares(std::uint32_t from, std::span<const std::uint32_t> to) {
    if (squares_.size() < to.size() + kMaxCostLanes) squares_.resize(to.size() + kMaxCostLanes);
    if (quadric_[from].weight > 0)
        edgeSquares({sites_[from], quadric_[from], sites_, to}, weights_, squares_.data());
    else
        std::transform(to.begin(), to.end(), squares_.begin(), [&](std::uint32_t q) { return square(from, q); });
    return std::span(squares_).first(to.size());
}

} // namespace gnomon::simplify
