// Reading of a whole MeshSource for tests, with checks of the guarantees of its blocks.
#pragma once

#include "core/error.h"
#include "preprocess/read/mesh_source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace gnomon::read {

/// Writes a temporary file. It avoids AtomicFile and overwriting, because both wait for the disk and there are
/// thousands of such files.
inline void writeScratch(const std::string& path, const std::string& text) {
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary) << text;
}

/// Returns the message of the Error that `read` throws about the file `path`, without the path. The message must be one
/// line that begins with the path. Returns "no error" without an exception.
template <class Read>
std::string errorAbout(const std::string& path, const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(path)) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message.substr(std::min(message.size(), path.size()));
    }
    return "no error";
}

struct CollectedMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> colors;
    std::vector<TriangleCorners> triangles;
    std::vector<PolygonRun> polygons; // relative to the whole mesh, modulo 2^32
    std::uint64_t notAPolygon = 0;

    bool operator==(const CollectedMesh& other) const {
        const auto samePolygon = [](const PolygonRun& a, const PolygonRun& b) {
            return a.first == b.first && a.count == b.count;
        };
        return positions == other.positions && normals == other.normals && colors == other.colors &&
               triangles == other.triangles && notAPolygon == other.notAPolygon &&
               std::equal(polygons.begin(), polygons.end(), other.polygons.begin(), other.polygons.end(), samePolygon);
    }
};

inline CollectedMesh collect(MeshSource& source) {
    CollectedMesh mesh;
    source.readVertices([&](const VertexBlock& block) {
        EXPECT_EQ(block.firstVertex, mesh.positions.size());
        EXPECT_TRUE(block.normals.empty() || block.normals.size() == block.positions.size());
        EXPECT_TRUE(block.colors.empty() || block.colors.size() == block.positions.size());
        mesh.positions.insert(mesh.positions.end(), block.positions.begin(), block.positions.end());
        mesh.normals.insert(mesh.normals.end(), block.normals.begin(), block.normals.end());
        mesh.colors.insert(mesh.colors.end(), block.colors.begin(), block.colors.end());
    });
    EXPECT_EQ(mesh.positions.size(), source.summary().vertexCount);
    source.readTriangles([&](const TriangleBlock& block) {
        EXPECT_EQ(block.firstTriangle, mesh.triangles.size());
        for (const PolygonRun& run : block.polygons) {
            EXPECT_LE(run.first + run.count, block.triangles.size());
            mesh.polygons.push_back({static_cast<std::uint32_t>(block.firstTriangle + run.first), run.count});
        }
        mesh.triangles.insert(mesh.triangles.end(), block.triangles.begin(), block.triangles.end());
        mesh.notAPolygon += block.notAPolygon;
    });
    for (const TriangleCorners& triangle : mesh.triangles)
        for (const std::uint64_t corner : triangle) {
            EXPECT_LT(corner, mesh.positions.size());
            requireFinite(source, corner, mesh.positions.at(corner));
        }
    return mesh;
}

} // namespace gnomon::read
