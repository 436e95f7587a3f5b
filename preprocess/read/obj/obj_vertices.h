// Finds the vertices that the faces of an OBJ file need. A vertex whose corners have different normals or colours is
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

/// Returns true if at least three corners have different vertices. A face without three such corners has no triangles.
bool isObjFace(std::span<const ObjCorner> corners);

/// A copy of a vertex of the OBJ file with another normal or colour.
struct ObjVariant {
    std::uint32_t vertex = 0;
    std::uint32_t normal = 0; ///< index of a normal in the file, or ObjVertices::kOwn
    std::uint32_t color = 0;
};

/// Finds the vertices that the faces of an OBJ file need. The caller passes all faces twice in the same order: first to
/// `add`, which collects the vertices, and then to `cornersOf`, which returns their indices.
class ObjVertices {
public:
    /// A normal index that means the own normal of a vertex, which is the first normal that a face gives to it. If no
    /// face gives a normal to the vertex, the value means "no normal".
    static constexpr std::uint32_t kOwn = std::numeric_limits<std::uint32_t>::max();

    struct Options {
        std::string path;
        Bytes memoryLimit;
        std::uint64_t vertexCount = 0;
        bool hasAlignedNormals = false; ///< whether each corner has the same index for its normal and its vertex
        bool hasFaceColors = false;
    };

    /// Prepares for `options.vertexCount` vertices. `normals` are the normals of the file in file order, with zero for
    /// normals that are not finite. The list is empty if each corner has the same index for normal and vertex.
    /// `normalCount` is the number of normals in the file.
    ObjVertices(Options options, std::vector<glm::vec3> normals, std::uint64_t normalCount);

    /// Collects the vertices that `face` needs, with their normals and colours.
    void add(const ObjLine& face);

    /// Sorts the collected vertices. The caller must call this function after the last `add`.
    void finish();

    /// Prepares for passing all faces a second time. The caller must call this function before the first `cornersOf`.
    void begin() { forgetOthers(); }

    /// Returns the output vertex indices at the corners of `face`. Returns an empty list if fewer than three corners
    /// are different.
    std::span<const std::uint64_t> cornersOf(const ObjLine& face);

    /// Returns the number of output vertices, including the copies of duplicated vertices.
    std::uint64_t count() const { return firstVariant_ + variants_.size(); }

    /// Returns the index in the file of the vertex from which the output vertex `vertex` comes.
    std::uint64_t ofFile(std::uint64_t vertex) const;

    bool hasNormals() const { return hasNormals_; }

    /// Returns true if the output contains the file's vertex `vertex` with its own normal and own colour.
    bool isThere(std::uint64_t vertex) const { return !options_.hasFaceColors || isUsed_[vertex]; }

    /// Returns the index of the first normal that a face gives to `vertex`. Returns kOwn if no face gives a normal to
    /// it.
    std::uint32_t ownNormal(std::uint64_t vertex) const;

    const glm::vec3& normal(std::uint32_t number) const { return normals_[number]; }

    std::uint32_t ownColor(std::uint64_t vertex) const { return ownColors_.empty() ? 0xFFFFFFFF : ownColors_[vertex]; }

    /// Returns the copies of duplicated vertices, ordered by vertex. In the output, they follow all other vertices.
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
    std::vector<bool> hasOwnNormal_;        ///< used only if normals and vertices have equal indices in each corner
    std::vector<std::uint32_t> ownNormals_; ///< used only otherwise: index of the first normal per vertex
    std::vector<std::uint32_t> ownColors_;
    std::vector<bool> isUsed_; ///< whether a face uses the vertex with its own normal and colour, per vertex
    std::vector<std::uint64_t> usedBefore_;
    std::vector<ObjVariant> variants_;
    std::size_t compacted_ = 0;
    std::uint64_t firstVariant_ = 0;
    /// Maps a vertex to a normal that differs from its own normal. The map contains corners of the current face, and of
    /// the faces directly before it that are not polygons. It is fast even for faces with up to a million corners.
    std::unordered_map<std::uint64_t, std::uint32_t> others_;
    std::vector<std::uint64_t> corners_;
};

} // namespace gnomon::read
