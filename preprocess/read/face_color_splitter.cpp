#include "preprocess/read/face_color_splitter.h"

#include "core/error.h"

#include <algorithm>
#include <limits>

namespace gnomon::read {

namespace {

constexpr unsigned kColorBits = 32;
constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << kColorBits;

/// The max memory per corner in bytes. It includes four 64-bit values, because the corner's key is copied for sorting,
/// and two vertices, because a growing array can reserve twice its size.
constexpr std::uint64_t kBytesPerCorner =
    4 * sizeof(std::uint64_t) + 2 * (sizeof(glm::dvec3) + sizeof(glm::vec3) + sizeof(std::uint32_t));

} // namespace

void FaceColorSplitter::requireRoom() const {
    const std::uint64_t needed = bytesOf(mesh_.positions) + bytesOf(mesh_.normals) + bytesOf(mesh_.faceSizes) +
                                 2 * bytesOf(mesh_.fields) + mesh_.corners.size() * kBytesPerCorner;
    if (needed > memoryLimit_.count || mesh_.positions.size() > kMaxVertices)
        throw Error(
            path_,
            "too large: face colours are read into memory as a whole (vertex colours are streamed)",
            "at most " + readableBytes(memoryLimit_) + " of memory",
            "a need for more than " + readableBytes({needed}));
}

void FaceColorSplitter::addVertices(const VertexBlock& block) {
    mesh_.positions.insert(mesh_.positions.end(), block.positions.begin(), block.positions.end());
    mesh_.normals.insert(mesh_.normals.end(), block.normals.begin(), block.normals.end());
    mesh_.fields.insert(mesh_.fields.end(), block.fields.begin(), block.fields.end());
    if (block.badNormals > 0) mesh_.attributesDropped[kBadNormals] += block.badNormals;
    requireRoom();
}

void FaceColorSplitter::addFace(std::span<const std::uint64_t> corners, std::uint32_t color) {
    mesh_.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
    for (const std::uint64_t corner : corners)
        mesh_.corners.push_back(corner << kColorBits | color);
    requireRoom();
}

MemoryMesh FaceColorSplitter::take() {
    std::vector<std::uint64_t> names = mesh_.corners;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (std::uint64_t& corner : mesh_.corners)
        corner = static_cast<std::uint64_t>(std::lower_bound(names.begin(), names.end(), corner) - names.begin());
    const std::vector<glm::dvec3> positions = std::move(mesh_.positions);
    const std::vector<glm::vec3> normals = std::move(mesh_.normals);
    const std::vector<double> fields = std::move(mesh_.fields);
    const std::size_t fieldCount = mesh_.fieldNames.size();
    mesh_.positions.clear();
    mesh_.normals.clear();
    mesh_.fields.clear();
    for (const std::uint64_t name : names) {
        mesh_.positions.push_back(positions[name >> kColorBits]);
        if (!normals.empty()) mesh_.normals.push_back(normals[name >> kColorBits]);
        for (std::size_t field = 0; field < fieldCount; ++field)
            mesh_.fields.push_back(fields[(name >> kColorBits) * fieldCount + field]);
        mesh_.colors.push_back(static_cast<std::uint32_t>(name & std::numeric_limits<std::uint32_t>::max()));
    }
    return std::move(mesh_);
}

MemoryMesh withFaceColors(
    MemoryMesh mesh, std::span<const std::uint32_t> colors, const std::string& path, Bytes memoryLimit) {
    FaceColorSplitter splitter(path, memoryLimit, {});
    splitter.addVertices({0, mesh.positions, mesh.normals, {}, {}});
    std::size_t first = 0;
    for (std::size_t face = 0; face < mesh.faceSizes.size(); ++face) {
        splitter.addFace(std::span(mesh.corners).subspan(first, mesh.faceSizes[face]), colors[face]);
        first += mesh.faceSizes[face];
    }
    MemoryMesh split = splitter.take();
    split.attributesDropped = std::move(mesh.attributesDropped);
    split.remarks = std::move(mesh.remarks);
    split.notAPolygon = mesh.notAPolygon;
    return split;
}

} // namespace gnomon::read
