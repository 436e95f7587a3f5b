// The lines of an OBJ one after the other, as vertices, normals and faces, without holding any of them.
#pragma once

#include "preprocess/read/obj/obj_materials.h"
#include "preprocess/read/text/text_stream.h"

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

/// What a line may be. `vc` lines have colours of vertices, in their order.
enum class ObjKind : std::uint8_t { Vertex = 1, Normal = 2, Face = 4, Color = 8 };

/// Some kinds together.
using ObjKinds = std::uint8_t;

constexpr ObjKinds kindBit(ObjKind kind) {
    return static_cast<ObjKinds>(kind);
}

constexpr ObjKinds kAllObjKinds =
    kindBit(ObjKind::Vertex) | kindBit(ObjKind::Normal) | kindBit(ObjKind::Face) | kindBit(ObjKind::Color);

/// One of them. A member of another kind means nothing.
struct ObjLine {
    ObjKind kind = ObjKind::Vertex;
    glm::dvec3 vector{0};                  ///< a position or a normal, finite or not
    std::optional<glm::dvec3> vertexColor; ///< red, green, blue, as they stand there
    std::span<const ObjCorner> corners;    ///< valid until the next line
    std::uint32_t faceColor = 0xFFFFFFFF;  ///< RGBA8, of the material in use
};

/// A stretch of whole lines of the file, and what stands before it and in it.
struct ObjStretch {
    std::uint64_t offset = 0; ///< bytes
    std::uint64_t line = 0;   ///< lines before
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    ObjKinds kinds = 0; ///< in it; a face for a material as well
};

/// What a first pass over an OBJ finds.
struct ObjSurvey {
    std::vector<ObjStretch> stretches;                      ///< of about a MiB each
    std::map<std::string, std::uint64_t> attributesDropped; ///< what is neither read nor a material
    std::map<std::string, std::uint64_t> unknownKeywords;   ///< and their lines
};

/// A pass over an OBJ. Throws Error with path and line at the first line that is not one.
class ObjLines {
public:
    /// The first pass, over every line: fills `survey`, which must be empty, and reads the libraries of `materials`.
    ObjLines(const InputFile& file, ObjMaterials& materials, ObjSurvey& survey);

    /// A later pass, over lines of `wanted` kinds alone, with what the first pass found.
    ObjLines(const InputFile& file, const ObjMaterials& materials, const ObjSurvey& survey, ObjKinds wanted);

    /// False at the end.
    bool next(ObjLine& line);

    /// "PATH:LINE" of the line in hand.
    std::string where() const { return text_.where(); }

    std::uint64_t vertices() const { return vertices_; }

    std::uint64_t normals() const { return normals_; }

private:
    void beginStretch();
    bool passOver();
    bool take(std::string_view keyword, ObjLine& line);
    void takeVector(ObjKind kind, ObjLine& line);
    void takeVertexColor(ObjLine& line);
    void takeFace(ObjLine& line);
    void takeMaterial();
    void surveyOther(std::string_view keyword);
    void countUnknown(std::string_view keyword);
    void countVector(ObjKind kind);
    void note(ObjKind kind);

    TextStream text_;
    const ObjMaterials& materials_;
    ObjMaterials* libraries_ = nullptr; // to be read, in the first pass
    ObjSurvey* survey_ = nullptr;       // to be filled, in the first pass
    std::span<const ObjStretch> stretches_;
    std::size_t stretch_ = 0; // that comes next
    ObjKinds wanted_ = kAllObjKinds;
    std::uint64_t vertices_ = 0;
    std::uint64_t normals_ = 0;
    std::uint32_t color_ = 0xFFFFFFFF; // of the material in use
    std::vector<ObjCorner> corners_;
};

} // namespace gnomon::read
