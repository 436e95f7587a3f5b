// The lines of an OBJ one after the other, as vertices, normals and faces, without holding any of them.
#pragma once

#include "preprocess/read/byte_stream.h"
#include "preprocess/read/line_guards.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::read {

/// A corner of a face; both count from 0. What goes back too far wraps, and is beyond any end.
struct ObjCorner {
    static constexpr std::uint64_t kNoNormal = ~std::uint64_t{0};

    std::uint64_t vertex = 0;
    std::uint64_t normal = kNoNormal;
};

/// What a line may be.
enum class ObjKind : std::uint8_t { Vertex = 1, Normal = 2, Face = 4 };

/// Some kinds together.
using ObjKinds = std::uint8_t;

constexpr ObjKinds kindBit(ObjKind kind) {
    return static_cast<ObjKinds>(kind);
}

constexpr ObjKinds kAllObjKinds = kindBit(ObjKind::Vertex) | kindBit(ObjKind::Normal) | kindBit(ObjKind::Face);

/// One of them. What is not of its kind means nothing.
struct ObjLine {
    ObjKind kind = ObjKind::Vertex;
    glm::vec3 vector{0};                  ///< a position or a normal
    std::optional<glm::vec3> vertexColor; ///< red, green, blue, as they stand there
    std::span<const ObjCorner> corners;   ///< valid until the next line
    std::uint32_t faceColor = 0xFFFFFFFF; ///< RGBA8, of the material in use
};

/// A stretch of whole lines of the file, and what stands before it and in it.
struct ObjStretch {
    std::uint64_t offset = 0; ///< bytes
    std::uint64_t line = 0;   ///< lines before
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    ObjKinds kinds = 0; ///< in it; a face for a material as well
};

/// A pass over an OBJ. Throws Error with path and line at the first line that is not one, as ObjGuard has it.
class ObjLines {
public:
    /// Every line, and stretches of about a MiB go to `found`, which must be empty.
    ObjLines(const InputFile& file, std::vector<ObjStretch>* found);

    /// Lines of `wanted` kinds alone; what they stand in is found by `stretches` of a whole pass.
    ObjLines(const InputFile& file, std::span<const ObjStretch> stretches, ObjKinds wanted);

    /// False at the end.
    bool next(ObjLine& line);

    /// "PATH:LINE" of the line in hand.
    std::string where() const;

    std::uint64_t vertices() const { return vertices_; }

    std::uint64_t normals() const { return normals_; }

    const ObjMaterials& materials() const { return guard_.materials(); }

    /// What the lines so far have that is neither read nor a material.
    std::map<std::string, std::uint64_t> leftOut() const;

    /// Lines of colours of vertices apart from their positions (`vc`).
    std::uint64_t colorLines() const { return colorLines_; }

private:
    bool nextText(std::string_view& text);
    bool longText(std::string_view& text);
    void beginStretch();
    bool passOver();
    bool take(std::string_view text, ObjLine& line);
    bool takeGuarded(std::string_view text, ObjLine& line);
    bool takeWords(std::string_view text, ObjLine& line);
    bool takeVector(std::string_view rest, ObjKind kind, ObjLine& line);
    bool takeFace(std::string_view rest, ObjLine& line);
    void countVector(ObjKind kind);
    void note(ObjKind kind);

    const InputFile& file_;
    ByteStream stream_;
    ObjGuard guard_;
    std::vector<ObjStretch>* found_ = nullptr;
    std::span<const ObjStretch> stretches_;
    std::size_t stretch_ = 0; // that comes next
    ObjKinds wanted_ = kAllObjKinds;
    bool isContinued_ = false;
    std::string long_; // a line that the buffer does not hold
    std::string guarded_;
    std::size_t given_ = 0; // bytes of the line in hand
    std::uint64_t lineNumber_ = 0;
    std::uint64_t vertices_ = 0;
    std::uint64_t normals_ = 0;
    std::uint64_t colorLines_ = 0;
    std::uint64_t texcoordLines_ = 0;
    std::vector<ObjCorner> corners_;
};

} // namespace gnomon::read
