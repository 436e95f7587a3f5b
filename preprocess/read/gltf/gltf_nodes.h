// The nodes of a scene of glTF: which meshes stand where.
#pragma once

#include "preprocess/read/gltf/gltf_file.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::read {

/// A mesh, placed.
struct PlacedMesh {
    int mesh = 0;
    glm::dmat4 toWorld{1};
};

/// All meshes of the default scene (the first where none is named; all roots where there is no scene), node by node,
/// each before its children, instances of EXT_mesh_gpu_instancing one after the other. Throws Error for nodes that are
/// no trees, or that refer to what is not there. glTF 2.0, section 3.5.
std::vector<PlacedMesh> placedMeshes(GltfFile& file);

} // namespace gnomon::read
