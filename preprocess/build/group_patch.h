// From a group of the level to a patch with its own numbering, its shared positions locked.
#pragma once

#include "preprocess/build/level.h"
#include "preprocess/build/patch.h"

#include <span>

namespace gnomon::preprocess {

/// Which group uses each position of the mesh, or that several do, or triangles outside the mesh.
class PositionOwners {
public:
    PositionOwners(const Mesh& mesh, const Level& level);

    bool isShared(std::uint32_t position) const { return owners_[position] == kShared; }

private:
    static constexpr std::uint32_t kShared = hierarchy::kNone - 1;

    std::vector<std::uint32_t> owners_;
};

struct GroupPatch {
    Patch patch;
    std::vector<std::uint32_t> globalVertex; // of each vertex of the patch
};

/// The patch of `triangles` (vertices of `mesh`).
GroupPatch makeGroupPatch(const Mesh& mesh, std::span<const Triangle> triangles, const PositionOwners& owners);

} // namespace gnomon::preprocess
