// The input and the output of the simplification of one group of clusters. Each group has its own numbers for vertices
// and positions.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <glm/glm.hpp>

#include <cmath>
#include <limits>
#include <span>

namespace gnomon::simplify {

/// The error bounds of one triangle of a level of detail, in grid steps. Each point of the source mesh is mapped to one
/// triangle of the level. The error of the point is stored with this triangle.
struct TriangleError {
    float fromSource = 0; // max distance from the triangle to a source point that is mapped to it
    float toSource = 0;   // max distance from a point of this triangle to the source mesh
};

/// Returns the smallest float that is at least `value`.
inline float roundedUp(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                                                : rounded;
}

/// The max cost of an edge collapse. MeanEdge: a few mean edge lengths of the patch. None: no limit.
enum class CostLimit { MeanEdge, None };

/// The triangles of one group of clusters, as input of the simplification. Lengths are in grid steps. Positions are
/// relative to a point near the patch and are exact.
struct Patch {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> positionOf; // index of each vertex's position
    std::vector<glm::dvec3> positions;
    std::vector<std::uint8_t> isLocked;    // per position: 1 if another group shares it, so that it must not move
    std::vector<Triangle> triangles;       // vertex indices
    hierarchy::PageFields fields;          // fields of the vertices
    std::span<const TriangleError> errors; // error of each triangle; empty if the triangles are the source itself
    CostLimit costLimit = CostLimit::None;
    bool isErrorBounded = true; // whether the simplifier must compute error bounds

    TriangleError error(std::size_t triangle) const { return errors.empty() ? TriangleError{} : errors[triangle]; }

    Triangle corners(const Triangle& t) const { return {positionOf[t[0]], positionOf[t[1]], positionOf[t[2]]}; }
};

/// A simplified patch. It uses the vertices and positions of the original patch. Locked positions do not move. After
/// the collapse of a position, its vertex remains in use at the new position if no vertex there has the same colour.
struct SimplifiedPatch {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> origin; // per triangle: the triangle of the original patch that it was; kNone if unknown
    // For each position, the position onto which it was collapsed. A position that did not move contains itself.
    std::vector<std::uint32_t> movedTo;
    std::vector<TriangleError> errors; // error bound of each triangle; empty if unknown or not needed
    double estimatedError = 0;         // estimate of the simplifier, in grid steps; not a bound
    // max error in grid steps of a triangle that may have moved to the other side of a layer (layer_gaps.h)
    double layerCharge = 0;

    /// Returns the position that `vertex` has after the simplification. `vertex` is a vertex of the original patch.
    std::uint32_t positionOf(const Patch& patch, std::uint32_t vertex) const {
        return movedTo[patch.positionOf[vertex]];
    }

    /// Returns the corner positions of `t`, which is a triangle of the simplified patch.
    Triangle corners(const Patch& patch, const Triangle& t) const {
        return {positionOf(patch, t[0]), positionOf(patch, t[1]), positionOf(patch, t[2])};
    }
};

} // namespace gnomon::simplify
