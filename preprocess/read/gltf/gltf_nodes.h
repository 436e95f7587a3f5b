// Reads the nodes of a glTF scene, which place meshes and cameras in world space.
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

/// A mesh of the glTF file with its transform to world space.
struct PlacedMesh {
    int mesh = 0;
    glm::dmat4 toWorld{1};
};

/// Returns the power of two that scales `largest` to the range [1, 2). Returns 1 for 0 and for values that are not
/// finite. Scaling by a power of two causes no rounding. The square of the scaled value is neither infinite nor 0.
inline double scaleToOne(double largest) {
    if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return 1;
    return std::scalbn(1.0, std::min(-std::ilogb(largest), std::numeric_limits<double>::max_exponent - 1));
}

/// The placed meshes and the cameras of a glTF scene.
struct GltfScene {
    /// The placed meshes, node by node. Each node comes before its children. The instances of EXT_mesh_gpu_instancing
    /// follow one another.
    std::vector<PlacedMesh> meshes;

    /// The cameras in the order of the glTF file's list of cameras. If several nodes use the same camera, the results
    /// have the order of the nodes. A camera looks along -z of its node, and y is up. The scale of the node changes
    /// only the position of the camera (glTF 2.0, section 3.10). For an orthographic camera, the target is at the
    /// distance where a vertical field of view of `fovYRadians` shows the camera's height.
    std::vector<Camera> cameras;

    std::map<std::string, std::uint64_t> rejected; ///< unused parts of the scene by name, with their counts
};

/// Returns the default scene of the glTF file. If no default scene is named, returns the first scene, or all root nodes
/// if there is no scene. Quaternions are scaled to unit length. A quaternion of length 0 means no rotation and is
/// counted. Throws Error if nodes do not form trees, if a transform has the wrong number of values, or if an index
/// refers to a missing entry. Source: glTF 2.0, section 3.5.
GltfScene sceneOf(GltfFile& file);

} // namespace gnomon::read
