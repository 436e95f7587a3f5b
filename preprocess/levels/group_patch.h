// Converts a group of clusters to a patch, the input of the simplification. A patch has its own vertex numbers.
// Positions that other groups share are locked.
#pragma once

#include "preprocess/levels/level.h"
#include "preprocess/levels/local_numbers.h"
#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::levels {

/// Tells which positions of a mesh are shared. A position is shared if several groups, or triangles outside the mesh,
/// use it.
class PositionOwners {
public:
    PositionOwners(const simplify::Mesh& mesh, const Level& level);

    bool isShared(std::uint32_t position) const { return owners_[position] == kShared; }

private:
    static constexpr std::uint32_t kShared = hierarchy::kNone - 1;

    std::vector<std::uint32_t> owners_;
};

/// A patch, and the mesh vertex of each patch vertex.
struct GroupPatch {
    simplify::Patch patch;
    std::vector<std::uint32_t> globalVertex; // per patch vertex: the mesh vertex
};

/// Tables that map the vertices and positions of a mesh to their numbers in a patch. The tables are reused for many
/// patches.
struct PatchNumbers {
    explicit PatchNumbers(const simplify::Mesh& mesh) : vertices(mesh.vertices.size()), positions(mesh.positionCount) {}

    LocalNumbers vertices;
    LocalNumbers positions;
};

/// Returns a patch of `triangles`, whose corners are vertices of `mesh`. `numbers` receives the numbers of vertices and
/// positions in this patch.
GroupPatch makeGroupPatch(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const PositionOwners& owners,
    PatchNumbers& numbers);

} // namespace gnomon::levels
