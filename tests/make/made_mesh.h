// Made models in memory, and slow, plain answers about their topology.
#pragma once

#include "preprocess/make/made_model.h"

#include <map>
#include <utility>
#include <vector>

namespace gnomon::make {

/// A whole model at once.
struct MadeMesh {
    std::vector<glm::vec3> vertices;
    std::vector<MadeTriangle> triangles;
};

MadeMesh collect(const MadeModel& model);

/// `mesh` with vertices of the same position made one.
MadeMesh welded(const MadeMesh& mesh);

/// For each edge (smaller index first) how many triangles run along it upwards and downwards.
struct EdgeUse {
    int upwards = 0;
    int downwards = 0;
};

std::map<std::pair<std::uint64_t, std::uint64_t>, EdgeUse> edgeUses(const MadeMesh& mesh);

/// Sets of triangles that hang together by vertices.
std::uint64_t componentCount(const MadeMesh& mesh);

/// Triangles that have the same corners as an earlier one, in any order.
std::uint64_t doubledCount(const MadeMesh& mesh);

double area(const MadeMesh& mesh, const MadeTriangle& triangle);
double meanEdge(const MadeMesh& mesh);

} // namespace gnomon::make
