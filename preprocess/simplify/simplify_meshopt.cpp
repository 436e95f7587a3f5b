#include "preprocess/simplify/locked_edge_check.h"
#include "preprocess/simplify/simplify.h"

#include <algorithm>

#include <meshoptimizer.h>

namespace gnomon::simplify {

namespace {

/// The input of meshoptimizer: the patch, and two equal dummy triangles per locked vertex. The dummies make the vertex
/// non-manifold, so that meshoptimizer does not move it.
struct Input {
    std::vector<unsigned> indices;
    std::vector<float> positions;
    std::size_t dummyIndices = 0;

    Input(const Patch& patch, const std::vector<std::uint8_t>& isLocked) {
        const auto vertexCount = static_cast<unsigned>(patch.vertices.size());
        for (const std::uint32_t p : patch.positionOf)
            for (int axis = 0; axis < 3; ++axis)
                positions.push_back(static_cast<float>(patch.positions[p][axis]));
        for (unsigned dummy = 0; dummy < 2; ++dummy) { // near the first vertex, at positions that occur only once
            positions.push_back(positions[0] + 0.25F + 0.25F * static_cast<float>(dummy));
            positions.push_back(positions[1] + 0.25F);
            positions.push_back(positions[2] + 0.25F);
        }
        for (const Triangle& t : patch.triangles)
            indices.insert(indices.end(), t.begin(), t.end());
        for (unsigned v = 0; v < vertexCount; ++v) {
            if (isLocked[patch.positionOf[v]] == 0) continue;
            for (int twice = 0; twice < 2; ++twice)
                indices.insert(indices.end(), {v, vertexCount, vertexCount + 1});
            dummyIndices += 6;
        }
    }
};

std::vector<Triangle> simplified(
    const Patch& patch, const Input& input, std::size_t targetTriangles, float& estimated) {
    std::vector<unsigned> indices(input.indices.size());
    indices.resize(meshopt_simplify(
        indices.data(),
        input.indices.data(),
        input.indices.size(),
        input.positions.data(),
        input.positions.size() / 3,
        3 * sizeof(float),
        targetTriangles * 3 + input.dummyIndices,
        1e6F, // max error, as a multiple of the patch size; so large that it is no limit
        0,
        &estimated));
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const Triangle t{indices[i], indices[i + 1], indices[i + 2]};
        if (std::max({t[0], t[1], t[2]}) >= patch.vertices.size()) continue;
        const Triangle p = patch.corners(t);
        if (p[0] != p[1] && p[1] != p[2] && p[2] != p[0]) triangles.push_back(t);
    }
    return triangles;
}

} // namespace

SimplifiedPatch simplifyMeshopt(const Patch& patch, std::size_t targetTriangles) {
    SimplifiedPatch result;
    float estimated = 0;
    const Input input(patch, patch.isLocked);
    result.triangles = simplified(patch, input, targetTriangles, estimated);
    if (result.triangles.empty() || !keepsLockedEdges(patch, result.triangles))
        result.triangles = simplified(patch, Input(patch, lockedWithRing(patch)), targetTriangles, estimated);
    if (result.triangles.empty() || !keepsLockedEdges(patch, result.triangles)) {
        result.triangles = patch.triangles;
        estimated = 0;
    }
    result.origin.assign(result.triangles.size(), hierarchy::kNone);
    for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
        result.movedTo.push_back(p);
    result.estimatedError =
        double{estimated} * double{meshopt_simplifyScale(input.positions.data(), input.positions.size() / 3, 12)};
    return result;
}

} // namespace gnomon::simplify
