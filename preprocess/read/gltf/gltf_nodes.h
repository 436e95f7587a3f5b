// Reads the nodes of a glTF scene: placed meshes and cameras.
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

/// A mesh of the file with its transform to world space.
struct PlacedMesh {
    int mesh = 0;
    glm::dmat4 toWorld{1};
};

/// Returns the power of two that scales `largest` to at least 1 and below 2. Returns 1 for 0 and for values that are
/// not finite. The scaling is exact, and the square of the scaled value is neither infinite nor 0.
inline double scaleToOne(double largest) {
    if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return 1;
    return std::scalbn(1.0, std::min(-std::ilogb(largest), std::numeric_limits<double>::max_exponent - 1));
}

/// The placed meshes and the cameras of a scene.
struct GltfScene {
    /// Placed meshes node by node, each node before its children, and the instances of EXT_mesh_gpu_instancing one
    /// after the other.
    std::vector<PlacedMesh> meshes;

    /// Cameras in the order of the file's list, then of the nodes. A camera looks along -z of its node with y up. The
    /// scale of the node changes only its position (glTF 2.0, section 3.10). The target of an orthographic camera is at
    /// the distance where `fovYRadians` gives its height.
    std::vector<Camera> cameras;

    std::map<std::string, std::uint64_t> rejected; ///< unused parts and their counts
};

/// Returns the default scene. Uses the first scene if no default is named, and all root nodes if there is no scene.
/// Scales quaternions to unit length; one of length 0 means no rotation and is counted. Throws Error if nodes do not
/// form trees, if a transform has the wrong number of values, and if an index refers to a missing entry. glTF 2.0,
/// section 3.5.
GltfScene sceneOf(GltfFile& file);

} // namespace gnomon::read
