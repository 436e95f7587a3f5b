// Meshes of boxes, for buildings and gratings.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <fstream>
#include <string>
#include <vector>

namespace gnomon::path {

/// A mesh of boxes.
struct Boxes {
    std::vector<glm::dvec3> corners;
    std::vector<std::array<std::size_t, 4>> quads;

    void add(const glm::dvec3& min, const glm::dvec3& max) {
        const std::size_t first = corners.size();
        for (unsigned i = 0; i < 8; ++i)
            corners.emplace_back(
                (i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y, (i & 4U) != 0 ? max.z : min.z);
        constexpr std::array<std::array<std::size_t, 4>, 6> kSides{
            {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
        for (const auto& q : kSides)
            quads.push_back({first + q[0], first + q[1], first + q[2], first + q[3]});
    }

    void write(const std::string& path) const {
        std::ofstream file(path);
        file << "ply\nformat ascii 1.0\nelement vertex " << corners.size()
             << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << quads.size()
             << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const glm::dvec3& corner : corners)
            file << corner.x << ' ' << corner.y << ' ' << corner.z << '\n';
        for (const auto& q : quads)
            file << "4 " << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
    }
};

} // namespace gnomon::path
