// Coverage of a triangle without clipping and division, in doubles (Olano, Greer, "Triangle Scan Conversion using 2D
// Homogeneous Coordinates", 1997). It is slow, and simple for triangles that are partly behind the eye.
#pragma once

#include "raster/raster.h"

#include <glm/glm.hpp>

#include <optional>

namespace gnomon::raster {

/// A triangle, stored as the plane of each barycentric weight over (x, y, w).
class HomogeneousTriangle {
public:
    HomogeneousTriangle(const Cluster& cluster, std::uint32_t i, const View& view) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t* p = cluster.positions + std::size_t{3} * cluster.triangles[i][k];
            glm::dvec4 cell(1);
            for (int axis = 0; axis < 3; ++axis)
                cell[axis] = static_cast<double>(p[axis]) - static_cast<double>(view.eyeCell[axis]);
            clip_[k] = glm::dmat4(view.clipFromCell) * cell;
        }
        const glm::dmat3 m(
            glm::dvec3(clip_[0].x, clip_[0].y, clip_[0].w),
            glm::dvec3(clip_[1].x, clip_[1].y, clip_[1].w),
            glm::dvec3(clip_[2].x, clip_[2].y, clip_[2].w));
        inverse_ = glm::inverse(m);
    }

    /// Returns the depth at a point in normalised device coordinates, or nullopt if the triangle is not there in front
    /// of the eye.
    std::optional<double> depth(double x, double y) const {
        const glm::dvec3 weights = inverse_ * glm::dvec3(x, y, 1); // each divided by the point's w
        if (!(weights.x >= 0 && weights.y >= 0 && weights.z >= 0)) return std::nullopt;
        return weights.x * clip_[0].z + weights.y * clip_[1].z + weights.z * clip_[2].z;
    }

private:
    std::array<glm::dvec4, 3> clip_{};
    glm::dmat3 inverse_{1};
};

} // namespace gnomon::raster
