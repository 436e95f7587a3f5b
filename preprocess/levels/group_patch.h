// Converts a group of a level to a patch with its own numbering and locked shared positions.
#pragma once

#include "preprocess/levels/level.h"
#include "preprocess/levels/local_numbers.h"
#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::levels {

/// The owner of each position of the mesh: one group, or shared if several groups or triangles outside the mesh use it.
class PositionOwners {
public:
    PositionOwners(const simplify::Mesh& mesh, const Level& level);

    bool isShared(std::uint32_t position) const { return owners_[position] == kShared; }

private:
    static constexpr std::uint32_t kShared = hierarchy::kNone - 1;

    std::vector<std::uint32_t> owners_;
};

/// A patch with the mesh vertices that it was made from.
struct GroupPatch {
    simplify::Patch patch;
    std::vector<std::uint32_t> globalVertex; // mesh vertex of each patch vertex
};

/// Reusable tables that map vertices and positions of a mesh to their numbers in a patch.
struct PatchNumbers {
    explicit PatchNumbers(const simplify::Mesh& mesh) : vertices(mesh.vertices.size()), positions(mesh.positionCount) {}

    LocalNumbers vertices;
    LocalNumbers positions;
};

/// Makes the patch of `triangles` (vertices of `mesh`). The function overwrites `numbers` with the numbers of this
/// patch.
GroupPatch makeGroupPatch(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const PositionOwners& owners,
    PatchNumbers& numbers);

} // namespace gnomon::levels
