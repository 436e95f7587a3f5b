// What the faces of an OBJ make of its vertices: a vertex whose corners have different normals or colours is several.
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

/// Whether three of the corners differ: others are no face.
bool isObjFace(std::span<const ObjCorner> corners);

/// A vertex of the file as some corners have it, unlike others.
struct ObjVariant {
    std::uint32_t vertex = 0;
    std::uint32_t normal = 0; ///< of the file's; or ObjVertices::kOwn
    std::uint32_t color = 0;
};

/// Faces are given twice, in the same order: `add` finds what vertices there are, `cornersOf` names them.
class ObjVertices {
public:
    /// The normal that the vertex was given first, or none if it never was.
    static constexpr std::uint32_t kOwn = std::numeric_limits<std::uint32_t>::max();

    struct Options {
        std::string path;
        Bytes memoryLimit;
        std::uint64_t vertexCount = 0;
        bool hasAlignedNormals = false; ///< corner by corner the number of the normal is that of the vertex
        bool hasFaceColors = false;
    };

    /// `normals` as they stand in the file, unless they are aligned; finite ones.
    ObjVertices(Options options, std::vector<glm::vec3> normals, std::uint64_t normalCount);

    void add(const ObjLine& face);

    /// After the last face.
    void finish();

    /// Before the faces are given again.
    void begin() { forgetOthers(); }

    /// The vertices of `face`, empty where it is none: fewer than three different corners.
    std::span<const std::uint64_t> cornersOf(const ObjLine& face);

    std::uint64_t count() const { return firstVariant_ + variants_.size(); }

    /// Returns the vertex of the file that the delivered vertex `vertex` comes from.
    std::uint64_t ofFile(std::uint64_t vertex) const;

    bool hasNormals() const { return hasNormals_; }

    /// Whether `vertex` of the file is there as it is, with its own normal and `ownColor`.
    bool isThere(std::uint64_t vertex) const { return !options_.hasFaceColors || isUsed_[vertex]; }

    /// The number of its own normal; kOwn for none.
    std::uint32_t ownNormal(std::uint64_t vertex) const;

    const glm::vec3& normal(std::uint32_t number) const { return normals_[number]; }

    std::uint32_t ownColor(std::uint64_t vertex) const { return ownColors_.empty() ? 0xFFFFFFFF : ownColors_[vertex]; }

    /// What comes after the vertices that are there as they are, by vertex.
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
    std::vector<bool> hasOwnNormal_;        ///< where normals are aligned
    std::vector<std::uint32_t> ownNormals_; ///< else
    std::vector<std::uint32_t> ownColors_;
    std::vector<bool> isUsed_; ///< with its own normal and colour
    std::vector<std::uint64_t> usedBefore_;
    std::vector<ObjVariant> variants_;
    std::size_t compacted_ = 0;
    std::uint64_t firstVariant_ = 0;
    /// The normals that corners have in place of their vertices' own: of the face in hand, and of those before that
    /// were none. A face may have a million corners.
    std::unordered_map<std::uint64_t, std::uint32_t> others_;
    std::vector<std::uint64_t> corners_;
};

} // namespace gnomon::read
