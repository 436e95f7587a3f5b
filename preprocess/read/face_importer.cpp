#include "preprocess/read/face_importer.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::read {

namespace {

std::uint32_t channel(float value) {
    // The order of the comparisons makes a NaN 0.
    return static_cast<std::uint32_t>(value > 0 ? std::min(value, 1.0F) * 255.0F + 0.5F : 0.0F);
}

} // namespace

std::uint32_t packedChannels(const glm::vec4& rgba) {
    return channel(rgba.r) | channel(rgba.g) << 8U | channel(rgba.b) << 16U | channel(rgba.a) << 24U;
}

glm::vec3 finiteOrZero(const glm::vec3& normal) {
    return std::isfinite(normal.x + normal.y + normal.z) ? normal : glm::vec3(0);
}

FaceImporter::FaceImporter(std::function<std::string()> where, FaceHints hints)
    : where_(std::move(where)), hints_(std::move(hints)) {}

MemoryMesh FaceImporter::take() {
    const std::uint64_t first = mesh_.positions.size();
    for (const Twin& twin : twins_) {
        mesh_.positions.push_back(mesh_.positions[twin.vertex]);
        mesh_.normals.push_back(twin.normal);
        if (!mesh_.colors.empty()) mesh_.colors.push_back(mesh_.colors[twin.vertex]);
    }
    for (std::uint64_t& corner : mesh_.corners)
        if ((corner & kTwinBit) != 0) corner = first + (corner & ~kTwinBit);
    if (!mesh_.normals.empty()) mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0));
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), 0xFFFFFFFF);
    return std::exchange(mesh_, {});
}

OpenMesh::VertexHandle FaceImporter::add_vertex(const OpenMesh::Vec3f& point) {
    return add_vertex(OpenMesh::Vec3d(point));
}

OpenMesh::VertexHandle FaceImporter::add_vertex(const OpenMesh::Vec3d& point) {
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
        throw Error(where_(), "a coordinate is not finite");
    if (mesh_.positions.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw Error(where_(), "more vertices than a file that is read whole may have");
    mesh_.positions.emplace_back(point[0], point[1], point[2]);
    return OpenMesh::VertexHandle(static_cast<int>(mesh_.positions.size() - 1));
}

OpenMesh::VertexHandle FaceImporter::add_vertex() {
    return add_vertex(OpenMesh::Vec3d(0, 0, 0));
}

void FaceImporter::set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) {
    mesh_.positions[checked(vertex)] = {point[0], point[1], point[2]};
}

OpenMesh::FaceHandle FaceImporter::add_face(const VHandles& corners) {
    const std::span<const std::uint64_t> all = hints_.corners ? hints_.corners() : std::span<const std::uint64_t>();
    if (all.size() > corners.size()) {
        for (const std::uint64_t corner : all)
            mesh_.corners.push_back(cornerOf(checkedPlace(corner)));
    } else {
        for (const OpenMesh::VertexHandle corner : corners)
            mesh_.corners.push_back(cornerOf(checked(corner)));
    }
    mesh_.faceSizes.push_back(static_cast<std::uint32_t>(std::max(all.size(), corners.size())));
    if (hints_.color) faceColors_.push_back(hints_.color());
    otherNormals_.clear();
    return OpenMesh::FaceHandle(static_cast<int>(mesh_.faceSizes.size() - 1));
}

std::uint64_t FaceImporter::checked(OpenMesh::VertexHandle vertex) const {
    return checkedPlace(static_cast<std::uint64_t>(static_cast<std::int64_t>(vertex.idx())));
}

std::uint64_t FaceImporter::checkedPlace(std::uint64_t vertex) const {
    if (vertex >= mesh_.positions.size())
        throw Error(
            where_(),
            "vertex index out of range",
            "one of " + std::to_string(mesh_.positions.size()) + " vertices",
            "index " + std::to_string(static_cast<std::int64_t>(vertex)) + " counted from 0");
    return vertex;
}

std::uint64_t FaceImporter::cornerOf(std::uint64_t vertex) {
    const auto other = otherNormals_.find(vertex);
    if (other == otherNormals_.end()) return vertex;
    std::vector<std::uint64_t>& known = twinsOf_[vertex];
    for (const std::uint64_t twin : known)
        if (twins_[twin].normal == other->second) return kTwinBit | twin;
    known.push_back(twins_.size());
    twins_.push_back({vertex, other->second});
    return kTwinBit | known.back();
}

void FaceImporter::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) {
    const std::uint64_t index = checked(vertex);
    mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0));
    hasNormal_.resize(mesh_.positions.size(), false);
    const glm::vec3 usable = finiteOrZero({normal[0], normal[1], normal[2]});
    otherNormals_.erase(index);
    if (!hasNormal_[index])
        mesh_.normals[index] = usable;
    else if (mesh_.normals[index] != usable)
        otherNormals_[index] = usable;
    hasNormal_[index] = true;
}

void FaceImporter::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) {
    set_normal(vertex, OpenMesh::Vec3f(normal));
}

void FaceImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3uc& color) {
    setColor(vertex, glm::vec4(color[0], color[1], color[2], 255.0F) / 255.0F);
}

void FaceImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4uc& color) {
    setColor(vertex, glm::vec4(color[0], color[1], color[2], color[3]) / 255.0F);
}

void FaceImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& color) {
    setColor(vertex, {color[0], color[1], color[2], 1.0F});
}

void FaceImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4f& color) {
    setColor(vertex, {color[0], color[1], color[2], color[3]});
}

void FaceImporter::setColor(OpenMesh::VertexHandle vertex, const glm::vec4& rgba) {
    const std::uint64_t index = checked(vertex);
    mesh_.colors.resize(mesh_.positions.size(), 0xFFFFFFFF);
    mesh_.colors[index] = packedChannels(rgba);
}

} // namespace gnomon::read
