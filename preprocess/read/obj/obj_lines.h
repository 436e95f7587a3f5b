// Streams the lines of an OBJ as vertices, normals and faces. It does not store them.
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

/// A corner of a face. Both indices count from 0. A relative index that refers to an element before the first one wraps
/// to a value above every count.
struct ObjCorner {
    static constexpr std::uint64_t kNoNormal = ~std::uint64_t{0};

    std::uint64_t vertex = 0;
    std::uint64_t normal = kNoNormal;
};

/// The kind of a line. A `vc` line has the colour of a vertex. These lines are in the order of the vertices.
enum class ObjKind : std::uint8_t { Vertex = 1, Normal = 2, Face = 4, Color = 8 };

/// A set of kinds as bits.
using ObjKinds = std::uint8_t;

constexpr ObjKinds kindBit(ObjKind kind) {
    return static_cast<ObjKinds>(kind);
}

constexpr ObjKinds kAllObjKinds =
    kindBit(ObjKind::Vertex) | kindBit(ObjKind::Normal) | kindBit(ObjKind::Face) | kindBit(ObjKind::Color);

/// One line of the file. The members for other kinds of lines are undefined.
struct ObjLine {
    ObjKind kind = ObjKind::Vertex;
    glm::dvec3 vector{0};                  ///< position or normal; may be not finite
    std::optional<glm::dvec3> vertexColor; ///< red, green and blue as in the file
    std::span<const ObjCorner> corners;    ///< valid until the next line
    std::uint32_t faceColor = 0xFFFFFFFF;  ///< colour of the current material, RGBA8
};

/// A range of whole lines of the file, with the numbers of elements before it and the kinds of its lines.
struct ObjStretch {
    std::uint64_t offset = 0; ///< bytes from the start of the file
    std::uint64_t line = 0;   ///< number of lines before the range
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    ObjKinds kinds = 0; ///< kinds of the lines in the range; `usemtl` counts as a face
};

/// The result of the first pass over an OBJ.
struct ObjSurvey {
    std::vector<ObjStretch> stretches;                      ///< ranges of about 1 MiB each
    std::map<std::string, std::uint64_t> attributesDropped; ///< number of lines that are not read, by name
    std::map<std::string, std::uint64_t> unknownKeywords;   ///< number of lines per unknown keyword
};

/// One pass over the lines of an OBJ. It throws Error with path and line at the first line with a defect.
class ObjLines {
public:
    /// Starts the first pass, which reads each line. The pass fills `survey`, which must be empty, and reads the
    /// libraries into `materials`.
    ObjLines(const InputFile& file, ObjMaterials& materials, ObjSurvey& survey);

    /// Starts a later pass, which returns only lines of the kinds `wanted`. The pass skips ranges in which the first
    /// pass found no such lines.
    ObjLines(const InputFile& file, const ObjMaterials& materials, const ObjSurvey& survey, ObjKinds wanted);

    /// Reads the next line into `line`. Returns false at the end of the file.
    bool next(ObjLine& line);

    /// Returns "PATH:LINE" of the current line.
    std::string where() const { return text_.where(); }

    /// Returns the number of vertex lines so far.
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
    ObjMaterials* libraries_ = nullptr; // libraries to read in the first pass; else null
    ObjSurvey* survey_ = nullptr;       // result of the first pass; else null
    std::span<const ObjStretch> stretches_;
    std::size_t stretch_ = 0; // index of the next range
    ObjKinds wanted_ = kAllObjKinds;
    std::uint64_t vertices_ = 0;
    std::uint64_t normals_ = 0;
    std::uint32_t color_ = 0xFFFFFFFF; // colour of the current material
    std::vector<ObjCorner> corners_;
};

} // namespace gnomon::read
