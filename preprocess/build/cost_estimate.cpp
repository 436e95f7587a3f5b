#include "preprocess/build/cost_estimate.h"

#include "hierarchy/octahedral.h"

namespace gnomon::preprocess {

namespace {

constexpr double kBorderWeight = 2;   // of the squared length of an open edge, against the areas of faces
constexpr double kCreaseWeight = 0.5; // the same where normals or colours part

} // namespace

CostEstimate::CostEstimate(const Patch& patch, const LivingPatch& living)
    : patch_(patch), quadric_(patch.positions.size()) {
    addFacePlanes(living);
    addEdgePlanes(living);
    loadAttributes();
}

void CostEstimate::addFacePlanes(const LivingPatch& living) {
    for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t) {
        const glm::dvec3& normal = living.firstNormal(t);
        const double length = glm::length(normal);
        if (!(length > 0)) continue;
        const glm::dvec3& a = patch_.positions[living.positions(t)[0]];
        Quadric plane;
        plane.addPlane(normal / length, a, length * 0.5);
        for (const std::uint32_t p : living.positions(t))
            quadric_[p].add(plane);
    }
}

void CostEstimate::addEdgePlanes(const LivingPatch& living) {
    for (std::uint32_t corner = 0; corner < patch_.triangles.size() * 3; ++corner) {
        const EdgeKind kind = living.firstEdge(corner);
        if (kind == EdgeKind::Smooth) continue;
        const Triangle& t = living.positions(corner / 3);
        const std::uint32_t a = t[corner % 3];
        const std::uint32_t b = t[(corner % 3 + 1) % 3];
        const glm::dvec3 edge = patch_.positions[b] - patch_.positions[a];
        const glm::dvec3 upright = glm::cross(edge, living.firstNormal(corner / 3));
        const double length = glm::length(upright);
        if (!(length > 0)) continue;
        const double weight = squaredLength(edge) * (kind == EdgeKind::Open ? kBorderWeight : kCreaseWeight);
        Quadric plane;
        plane.addPlane(upright / length, patch_.positions[a], weight);
        quadric_[a].add(plane);
        quadric_[b].add(plane);
    }
}

void CostEstimate::loadAttributes() {
    bool hasNormals = false;
    bool hasColors = false;
    for (const Vertex& vertex : patch_.vertices) {
        hasNormals = hasNormals || vertex.normal != hierarchy::kNoNormal;
        hasColors = hasColors || vertex.color != patch_.vertices.front().color;
    }
    if (hasNormals) normal_.assign(patch_.positions.size(), glm::dvec3(0));
    if (hasColors) color_.assign(patch_.positions.size(), glm::dvec3(0));
    for (std::size_t v = patch_.vertices.size(); v-- > 0;) { // the first vertex of a position has the last word
        const Vertex& vertex = patch_.vertices[v];
        const std::uint32_t p = patch_.positionOf[v];
        if (hasNormals) normal_[p] = hierarchy::unpackNormal(vertex.normal);
        if (hasColors)
            color_[p] =
                glm::dvec3(vertex.color & 0xFFU, vertex.color >> 8U & 0xFFU, vertex.color >> 16U & 0xFFU) / 255.0;
    }
}

} // namespace gnomon::preprocess
