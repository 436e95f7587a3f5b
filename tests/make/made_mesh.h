// Generated models in memory, and simple topology checks.
#pragma once

#include "preprocess/make/made_model.h"

#include <map>
#include <utility>
#include <vector>

namespace gnomon::make {

/// A complete model.
struct MadeMesh {
    std::vector<glm::vec3> vertices;
    std::vector<MadeTriangle> triangles;
};

MadeMesh collect(const MadeModel& model);

/// Returns `mesh` with vertices at equal positions merged.
MadeMesh welded(const MadeMesh& mesh);

/// The use of an edge, from smaller to larger index: number of triangles along it in both directions.
struct EdgeUse {
    int upwards = 0;
    int downwards = 0;
};

std::map<std::pair<std::uint64_t, std::uint64_t>, EdgeUse> edgeUses(const MadeMesh& mesh);

/// Returns the number of connected components of triangles, connected by vertices.
std::uint64_t componentCount(const MadeMesh& mesh);

/// Returns the number of triangles with the same corners as an earlier one, in any order.
std::uint64_t doubledCount(const MadeMesh& mesh);

double area(const MadeMesh& mesh, const MadeTriangle& triangle);
double meanEdge(const MadeMesh& mesh);

} // namespace gnomon::make
