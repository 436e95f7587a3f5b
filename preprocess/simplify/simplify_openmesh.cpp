#include "preprocess/simplify/locked_edge_check.h"
#include "preprocess/simplify/simplify.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <cmath>

namespace gnomon::simplify {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};

using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// The patch as a half-edge mesh with vertices welded by position. Faces that a half-edge mesh cannot represent are
/// listed in `aside`, and their corners are locked.
struct Halfedges {
    HalfedgeMesh mesh;
    std::vector<std::uint32_t> faceTriangle; // per face: the index of its triangle in the patch
    std::vector<std::uint32_t> aside;        // triangles of the patch that are not in the half-edge mesh

    Halfedges(const Patch& patch, const std::vector<std::uint8_t>& isLocked) {
        for (const glm::dvec3& p : patch.positions)
            mesh.add_vertex(OpenMesh::Vec3d(p.x, p.y, p.z));
        const auto vertex = [](std::uint32_t p) { return OpenMesh::VertexHandle(static_cast<int>(p)); };
        for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
            mesh.status(vertex(p)).set_locked(isLocked[p] != 0);
        for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
            const Triangle p = patch.corners(patch.triangles[t]);
            if (isTaken(p, vertex) || !mesh.add_face(vertex(p[0]), vertex(p[1]), vertex(p[2])).is_valid()) {
                aside.push_back(t);
                for (const std::uint32_t corner : p)
                    mesh.status(vertex(corner)).set_locked(true);
                continue;
            }
            faceTriangle.push_back(t);
        }
        mesh.update_face_normals();
    }

private:
    /// Returns true if the half-edge mesh cannot contain another face `p`. The reason is a corner with a closed ring of
    /// faces, or an edge that already has a face on this side.
    template <class VertexOf>
    bool isTaken(const Triangle& p, VertexOf vertex) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (!mesh.is_boundary(vertex(p[i]))) return true;
            const OpenMesh::SmartHalfedgeHandle edge = mesh.find_halfedge(vertex(p[i]), vertex(p[(i + 1) % 3]));
            if (edge.is_valid() && !edge.is_boundary()) return true;
        }
        return false;
    }
};

/// Returns the vertex of the patch at position `p` that has the normal and colour of vertex `wanted`. If there is no
/// such vertex, returns the first vertex at `p`.
std::uint32_t vertexAt(const Patch& patch, std::uint32_t p, std::uint32_t wanted) {
    if (patch.positionOf[wanted] == p) return wanted;
    std::uint32_t best = hierarchy::kNone;
    for (std::uint32_t v = 0; v < patch.vertices.size(); ++v) {
        if (patch.positionOf[v] != p) continue;
        const bool isAlike = patch.vertices[v].normal == patch.vertices[wanted].normal &&
                             patch.vertices[v].color == patch.vertices[wanted].color;
        if (best == hierarchy::kNone || isAlike) best = v;
        if (isAlike) break;
    }
    return best;
}

SimplifiedPatch simplifiedWith(
    const Patch& patch, const std::vector<std::uint8_t>& isLocked, std::size_t targetTriangles) {
    Halfedges halfedges(patch, isLocked);
    HalfedgeMesh& mesh = halfedges.mesh;
    OpenMesh::Decimater::DecimaterT<HalfedgeMesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<HalfedgeMesh>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<HalfedgeMesh>::Handle flipping;
    decimater.add(quadric);
    decimater.add(flipping);
    decimater.module(quadric).unset_max_err();
    decimater.module(flipping).set_max_normal_deviation(75);
    SimplifiedPatch result;
    if (decimater.initialize())
        decimater.decimate_to_faces(
            0, targetTriangles > halfedges.aside.size() ? targetTriangles - halfedges.aside.size() : 1);
    for (const std::uint32_t t : halfedges.aside) {
        result.triangles.push_back(patch.triangles[t]);
        result.origin.push_back(t);
    }
    for (std::uint32_t f = 0; f < halfedges.faceTriangle.size(); ++f) {
        const OpenMesh::FaceHandle face(static_cast<int>(f));
        if (mesh.status(face).deleted()) continue;
        const std::uint32_t origin = halfedges.faceTriangle[f];
        const Triangle was = patch.corners(patch.triangles[origin]);
        // The half-edges of a face may start at any corner. Corners that did not move determine the original first
        // corner.
        std::vector<std::uint32_t> corners;
        for (auto it = mesh.cfv_ccwiter(face); it.is_valid(); ++it)
            corners.push_back(static_cast<std::uint32_t>(it->idx()));
        for (int turn = 0; turn < 2 && corners[0] != was[0] && corners[1] != was[1] && corners[2] != was[2]; ++turn)
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        Triangle triangle{};
        for (std::size_t i = 0; i < 3; ++i)
            triangle.at(i) = vertexAt(patch, corners[i], patch.triangles[origin].at(i));
        result.triangles.push_back(triangle);
        result.origin.push_back(origin);
    }
    for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
        result.movedTo.push_back(p);
    return result;
}

/// Turns off OpenMesh's own messages about rejected faces, because these faces are listed in `aside`. The first call of
/// `omerr` connects the stream to stderr without a lock (OpenMesh 9.0), so only one thread may make it.
void silenceOpenMesh() {
    static const bool isSilent = [] {
        omerr().disable();
        return true;
    }();
    static_cast<void>(isSilent);
}

} // namespace

SimplifiedPatch simplifyOpenMesh(const Patch& patch, std::size_t targetTriangles) {
    silenceOpenMesh();
    SimplifiedPatch result = simplifiedWith(patch, patch.isLocked, targetTriangles);
    if (result.triangles.empty() || !keepsLockedEdges(patch, result.triangles))
        result = simplifiedWith(patch, lockedWithRing(patch), targetTriangles);
    if (result.triangles.empty() || !keepsLockedEdges(patch, result.triangles)) {
        result.triangles = patch.triangles;
        result.origin.clear();
        for (std::uint32_t t = 0; t < patch.triangles.size(); ++t)
            result.origin.push_back(t);
    }
    return result;
}

} // namespace gnomon::simplify
