// What is simplified at once, one group of a mesh with its own numbering, and what comes out.
#pragma once

#include "preprocess/simplify/mesh.h"

#include <glm/glm.hpp>

#include <cmath>
#include <limits>
#include <span>

namespace gnomon::simplify {

/// Error bounds of one triangle of a level, in grid steps. Every source point is mapped to one triangle of the level,
/// which carries the error of it.
struct TriangleError {
    float fromSource = 0; // every source point that is mapped to this triangle is within this distance of it
    float toSource = 0;   // every point of this triangle is within this distance of the source
};

/// The least float that is not below `value`.
inline float roundedUp(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                                                : rounded;
}

/// The largest cost of a collapse: a few mean edge lengths of the patch, or no limit.
enum class CostLimit { MeanEdge, None };

/// A group's triangles. Lengths are in grid steps, positions relative to a point near the patch, all exact.
struct Patch {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> positionOf; // vertex -> position
    std::vector<glm::dvec3> positions;
    std::vector<std::uint8_t> isLocked;    // per position: shared with another group, must stay where it is
    std::vector<Triangle> triangles;       // vertex indices
    hierarchy::PageFields fields;          // of the vertices
    std::span<const TriangleError> errors; // of the triangles; empty for the source itself
    CostLimit costLimit = CostLimit::None;
    bool isErrorBounded = true; // whether the errors of the simplified triangles are asked for

    TriangleError error(std::size_t triangle) const { return errors.empty() ? TriangleError{} : errors[triangle]; }

    Triangle corners(const Triangle& t) const { return {positionOf[t[0]], positionOf[t[1]], positionOf[t[2]]}; }
};

/// A patch after simplification, in the patch's own vertices. No position is new, and locked positions stay. A vertex
/// whose position was collapsed may be in use at the position that it moved to, because no vertex there has its colour.
struct SimplifiedPatch {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> origin;  // per triangle the patch's triangle that it was, kNone where that is unknown
    std::vector<std::uint32_t> movedTo; // per position the one that it was collapsed into; itself where it stayed
    std::vector<TriangleError> errors;  // of the triangles, bounds; empty if unknown or not asked for
    double claimedError = 0;            // what the simplifier believes, in grid steps; no bound
    double layerCharge = 0; // grid steps: the largest charge of a triangle that may lie before another layer now

    /// Returns the position that `vertex` of `patch` has after simplification.
    std::uint32_t positionOf(const Patch& patch, std::uint32_t vertex) const {
        return movedTo[patch.positionOf[vertex]];
    }

    /// Returns the positions of the corners of `t`, one of `triangles`.
    Triangle corners(const Patch& patch, const Triangle& t) const {
        return {positionOf(patch, t[0]), positionOf(patch, t[1]), positionOf(patch, t[2])};
    }
};

} // namespace gnomon::simplify
