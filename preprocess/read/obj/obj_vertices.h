// Finds the vertices that the faces of an OBJ need. A vertex whose corners have different normals or colours is
// duplicated.
#pragma once

#include "core/units.h"
#include "preprocess/read/obj/obj_lines.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Returns true if at least three corners have different vertices. Other faces have no triangles.
bool isObjFace(std::span<const ObjCorner> corners);

/// A copy of a vertex of the file with another normal or colour.
struct ObjVariant {
    std::uint32_t vertex = 0;
    std::uint32_t normal = 0; ///< index of a normal of the file, or ObjVertices::kOwn
    std::uint32_t color = 0;
};

/// Finds the vertices that the faces of an OBJ need. The caller passes all faces twice in the same order: first to
/// `add`, which collects the vertices, and then to `cornersOf`, which returns their indices.
class ObjVertices {
public:
    /// Means the own normal of a vertex, which is the first normal that a face gives to it. If no face gives a normal
    /// to the vertex, it means "no normal".
    static constexpr std::uint32_t kOwn = std::numeric_limits<std::uint32_t>::max();

    struct Options {
        std::string path;
        Bytes memoryLimit;
        std::uint64_t vertexCount = 0;
        bool hasAlignedNormals = false; ///< each corner has the same index for its normal and its vertex
        bool hasFaceColors = false;
    };

    /// Prepares `options.vertexCount` vertices. `normals` are the normals of the file in file order; normals that are
    /// not finite are zero. The list is empty if the normals are aligned. `normalCount` is the number of normals in the
    /// file.
    ObjVertices(Options options, std::vector<glm::vec3> normals, std::uint64_t normalCount);

    /// Collects the vertices of `face`.
    void add(const ObjLine& face);

    /// Sorts the collected vertices. Call this after the last `add`.
    void finish();

    /// Starts the second sequence of faces. Call this before the first `cornersOf`.
    void begin() { forgetOthers(); }

    /// Returns the indices of the delivered vertices at the corners of `face`. Returns an empty list if fewer than
    /// three corners are different.
    std::span<const std::uint64_t> cornersOf(const ObjLine& face);

    /// Returns the number of delivered vertices, including copies of vertices.
    std::uint64_t count() const { return firstVariant_ + variants_.size(); }

    /// Returns the vertex of the file from which the delivered vertex `vertex` comes.
    std::uint64_t ofFile(std::uint64_t vertex) const;

    bool hasNormals() const { return hasNormals_; }

    /// Returns true if `vertex` of the file is delivered with its own normal and `ownColor`.
    bool isThere(std::uint64_t vertex) const { return !options_.hasFaceColors || isUsed_[vertex]; }

    /// Returns the index of the own normal of `vertex`, or kOwn if it has none.
    std::uint32_t ownNormal(std::uint64_t vertex) const;

    const glm::vec3& normal(std::uint32_t number) const { return normals_[number]; }

    std::uint32_t ownColor(std::uint64_t vertex) const { return ownColors_.empty() ? 0xFFFFFFFF : ownColors_[vertex]; }

    /// Returns the copies, ordered by vertex. They are delivered after all vertices with their own normal and colour.
    std::span<const ObjVariant> variants() const { return variants_; }

    std::uint64_t heldBytes() const;

private:
    void takeNormals(const ObjLine& face);
    void giveNormal(std::uint64_t vertex, std::uint32_t normal);
    void forgetOthers();
    ObjVariant variantOf(std::uint64_t vertex, std::uint32_t color) const;
    bool isOwn(const ObjVariant& variant) const;
    bool isBefore(const ObjVariant& a, const ObjVariant& b) const;
    void compact();
    void requireRoom() const;

    Options options_;
    std::vector<glm::vec3> normals_;
    std::uint64_t normalCount_;
    bool hasNormals_ = false;
    std::vector<bool> hasOwnNormal_;        ///< only if normals are aligned
    std::vector<std::uint32_t> ownNormals_; ///< only if normals are not aligned
    std::vector<std::uint32_t> ownColors_;
    std::vector<bool> isUsed_; ///< per vertex: whether a face uses it with its own normal and colour
    std::vector<std::uint64_t> usedBefore_;
    std::vector<ObjVariant> variants_;
    std::size_t compacted_ = 0;
    std::uint64_t firstVariant_ = 0;
    /// Normals of corners that differ from the own normals of their vertices. They are corners of the current face, and
    /// of the faces directly before it that are not polygons. The map is fast even for faces with up to a million
    /// corners.
    std::unordered_map<std::uint64_t, std::uint32_t> others_;
    std::vector<std::uint64_t> corners_;
};

} // namespace gnomon::read
