// An OpenMesh::IO importer that takes raw faces: no half-edges are built, so no face is refused.
#pragma once

#include "preprocess/read/memory_source.h"

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>

#include <functional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// RGBA8 of channels from 0 to 1, red in the lowest byte; what is none is 0.
std::uint32_t packedChannels(const glm::vec4& rgba);

/// `normal`, or zero where it is not finite.
glm::vec3 finiteOrZero(const glm::vec3& normal);

/// Collects what an OpenMesh reader finds. A normal or colour that is set again to another value for the next face is
/// kept per corner: the vertex gets a twin. Throws Error, placed by `where()`, for indices out of range and
/// coordinates that are not finite, out of the reader that called.
class FaceImporter final : public OpenMesh::IO::BaseImporter {
public:
    /// What is known of the face that a reader adds next, where it is known.
    struct FaceHints {
        std::function<std::uint32_t()> color; ///< RGBA8
        /// All its corners: OpenMesh's reader of OBJ leaves out those that repeat another, as where a polygon with a
        /// hole goes there and back.
        std::function<std::span<const std::uint64_t>()> corners;
    };

    explicit FaceImporter(std::function<std::string()> where, FaceHints hints = {});

    /// As the hints had them at each face, in their order; empty without hints.
    std::vector<std::uint32_t> takeFaceColors() { return std::move(faceColors_); }

    /// What was collected; afterwards the importer is empty.
    MemoryMesh take();

    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override;
    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d& point) override;
    OpenMesh::VertexHandle add_vertex() override;
    OpenMesh::FaceHandle add_face(const VHandles& corners) override;
    void set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) override;
    void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) override;
    void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3uc& color) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4uc& color) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& color) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4f& color) override;

    std::size_t n_vertices() const override { return mesh_.positions.size(); }

    std::size_t n_faces() const override { return mesh_.faceSizes.size(); }

    std::size_t n_edges() const override { return 0; }

    // What a triangle soup has no use for: half-edges, texture coordinates, status, colours and normals of faces.
    OpenMesh::HalfedgeHandle add_edge(OpenMesh::VertexHandle, OpenMesh::VertexHandle) override {
        return OpenMesh::HalfedgeHandle();
    }

    OpenMesh::FaceHandle add_face(OpenMesh::HalfedgeHandle) override { return OpenMesh::FaceHandle(); }

    void add_face_texcoords(
        OpenMesh::FaceHandle, OpenMesh::VertexHandle, const std::vector<OpenMesh::Vec2f>&) override {}

    void add_face_texcoords(
        OpenMesh::FaceHandle, OpenMesh::VertexHandle, const std::vector<OpenMesh::Vec3f>&) override {}

    void set_face_texindex(OpenMesh::FaceHandle, int) override {}

    void set_halfedge(OpenMesh::VertexHandle, OpenMesh::HalfedgeHandle) override {}

    void set_texcoord(OpenMesh::VertexHandle, const OpenMesh::Vec2f&) override {}

    void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec2f&) override {}

    void set_texcoord(OpenMesh::VertexHandle, const OpenMesh::Vec3f&) override {}

    void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec3f&) override {}

    void set_status(OpenMesh::VertexHandle, const OpenMesh::Attributes::StatusInfo&) override {}

    void set_status(OpenMesh::HalfedgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}

    void set_status(OpenMesh::EdgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}

    void set_status(OpenMesh::FaceHandle, const OpenMesh::Attributes::StatusInfo&) override {}

    void set_next(OpenMesh::HalfedgeHandle, OpenMesh::HalfedgeHandle) override {}

    void set_face(OpenMesh::HalfedgeHandle, OpenMesh::FaceHandle) override {}

    void request_face_texcoords2D() override {}

    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3uc&) override {}

    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4uc&) override {}

    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3f&) override {}

    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4f&) override {}

    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3uc&) override {}

    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4uc&) override {}

    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}

    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4f&) override {}

    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}

    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3d&) override {}

    void add_texture_information(int, std::string) override {}

private:
    std::uint64_t checked(OpenMesh::VertexHandle vertex) const;
    std::uint64_t checkedPlace(std::uint64_t vertex) const;
    std::uint64_t cornerOf(std::uint64_t vertex);
    void setColor(OpenMesh::VertexHandle vertex, const glm::vec4& rgba);

    // A vertex of the file with one more normal; corners name it by kTwinBit | its place here until `take`.
    struct Twin {
        std::uint64_t vertex;
        glm::vec3 normal;
    };

    static constexpr std::uint64_t kTwinBit = std::uint64_t{1} << 63U;

    std::function<std::string()> where_;
    FaceHints hints_;
    std::vector<std::uint32_t> faceColors_;
    MemoryMesh mesh_;
    std::vector<bool> hasNormal_;                               ///< by vertex of the file
    std::unordered_map<std::uint64_t, glm::vec3> otherNormals_; ///< set since the last face, unlike the first one
    std::vector<Twin> twins_;
    std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> twinsOf_; ///< places in twins_ by vertex of the file
};

} // namespace gnomon::read
