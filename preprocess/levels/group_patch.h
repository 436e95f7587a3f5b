// From a group of the level to a patch with its own numbering, its shared positions locked.
#pragma once

#include "preprocess/levels/level.h"
#include "preprocess/levels/local_numbers.h"
#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::levels {

/// Which group uses each position of the mesh, or that several do, or triangles outside the mesh.
class PositionOwners {
public:
    PositionOwners(const simplify::Mesh& mesh, const Level& level);

    bool isShared(std::uint32_t position) const { return owners_[position] == kShared; }

private:
    static constexpr std::uint32_t kShared = hierarchy::kNone - 1;

    std::vector<std::uint32_t> owners_;
};

struct GroupPatch {
    simplify::Patch patch;
    std::vector<std::uint32_t> globalVertex; // of each vertex of the patch
};

/// The numbers that vertices and positions of a mesh have in one patch after the other.
struct PatchNumbers {
    explicit PatchNumbers(const simplify::Mesh& mesh) : vertices(mesh.vertices.size()), positions(mesh.positionCount) {}

    LocalNumbers vertices;
    LocalNumbers positions;
};

/// The patch of `triangles` (vertices of `mesh`). `numbers` are of that mesh, and this patch's afterwards.
GroupPatch makeGroupPatch(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const PositionOwners& owners,
    PatchNumbers& numbers);

} // namespace gnomon::levels
