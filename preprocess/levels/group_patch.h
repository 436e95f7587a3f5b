// Converts a group of a level to a patch. The patch has its own numbering, and positions shared with other groups are
// locked.
#pragma once

#include "preprocess/levels/level.h"
#include "preprocess/levels/local_numbers.h"
#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::levels {

/// The owner of each position of the mesh. The owner is one group, or the position is shared if several groups or
/// triangles outside the mesh use it.
class PositionOwners {
public:
    PositionOwners(const simplify::Mesh& mesh, const Level& level);

    bool isShared(std::uint32_t position) const { return owners_[position] == kShared; }

private:
    static constexpr std::uint32_t kShared = hierarchy::kNone - 1;

    std::vector<std::uint32_t> owners_;
};

/// A patch, and for each of its vertices the mesh vertex.
struct GroupPatch {
    simplify::Patch patch;
    std::vector<std::uint32_t> globalVertex; // per patch vertex: the mesh vertex
};

/// Tables that map vertices and positions of a mesh to their numbers in a patch. They are reused for many patches.
struct PatchNumbers {
    explicit PatchNumbers(const simplify::Mesh& mesh) : vertices(mesh.vertices.size()), positions(mesh.positionCount) {}

    LocalNumbers vertices;
    LocalNumbers positions;
};

/// Returns a patch of `triangles`, whose corners are vertices of `mesh`. The function overwrites `numbers` with the
/// numbers of this patch.
GroupPatch makeGroupPatch(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const PositionOwners& owners,
    PatchNumbers& numbers);

} // namespace gnomon::levels
