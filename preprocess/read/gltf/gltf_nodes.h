// The nodes of a scene of glTF: the placed meshes and cameras.
#pragma once

#include "core/camera.h"
#include "preprocess/read/gltf/gltf_file.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace gnomon::read {

/// A mesh, placed.
struct PlacedMesh {
    int mesh = 0;
    glm::dmat4 toWorld{1};
};

/// Returns the power of two that brings `largest` to 1 or more, but below 2; 1 for 0 and for values that are not
/// finite. Squares of numbers that are scaled so are neither infinite nor 0, and the scaling is exact.
inline double scaleToOne(double largest) {
    if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return 1;
    return std::scalbn(1.0, std::min(-std::ilogb(largest), std::numeric_limits<double>::max_exponent - 1));
}

struct GltfScene {
    /// Node by node, each before its children, instances of EXT_mesh_gpu_instancing one after the other.
    std::vector<PlacedMesh> meshes;

    /// In the order of the file's list of cameras, then of nodes. A camera looks along -z of its node with y up, and
    /// the node's scale changes its position only (glTF 2.0, section 3.10). The target of an orthographic camera is at
    /// the depth where `fovYRadians` gives its height.
    std::vector<Camera> cameras;

    std::map<std::string, std::uint64_t> leftOut; ///< the parts that are not used, and their counts
};

/// Reads the default scene (the first if none is named; all roots if there is no scene). Quaternions are scaled to unit
/// length; one of length 0 turns nothing and is counted. Throws Error for nodes that are no trees, for a transform of
/// the wrong length, and for references to entries that are not there. glTF 2.0, section 3.5.
GltfScene sceneOf(GltfFile& file);

} // namespace gnomon::read
