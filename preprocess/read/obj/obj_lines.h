// Reads the lines of an OBJ file one by one and returns its vertices, normals and faces. It does not store the lines.
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

/// A corner of a face: the indices of a vertex and a normal, counted from 0. A relative index that refers to an element
/// before the first one wraps to a value above every valid index.
struct ObjCorner {
    static constexpr std::uint64_t kNoNormal = ~std::uint64_t{0};

    std::uint64_t vertex = 0;
    std::uint64_t normal = kNoNormal;
};

/// The kind of a line in an OBJ file. A `vc` line has the colour of a vertex. These lines have the same order as the
/// vertices.
enum class ObjKind : std::uint8_t { Vertex = 1, Normal = 2, Face = 4, Color = 8 };

/// A set of line kinds, one bit per kind.
using ObjKinds = std::uint8_t;

constexpr ObjKinds kindBit(ObjKind kind) {
    return static_cast<ObjKinds>(kind);
}

constexpr ObjKinds kAllObjKinds =
    kindBit(ObjKind::Vertex) | kindBit(ObjKind::Normal) | kindBit(ObjKind::Face) | kindBit(ObjKind::Color);

/// One parsed line of an OBJ file. Only the members for the kind of this line are defined.
struct ObjLine {
    ObjKind kind = ObjKind::Vertex;
    glm::dvec3 vector{0};                  ///< position or normal, possibly not finite
    std::optional<glm::dvec3> vertexColor; ///< red, green and blue with the numbers of the file
    std::span<const ObjCorner> corners;    ///< corners of a face, valid until the next line is read
    std::uint32_t faceColor = 0xFFFFFFFF;  ///< RGBA8 colour of the face's material
};

/// A range of whole lines of an OBJ file. Stores the numbers of vertices and normals before it and the kinds of its
/// lines.
struct ObjStretch {
    std::uint64_t offset = 0; ///< bytes from the start of the file
    std::uint64_t line = 0;   ///< number of lines before the range
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    ObjKinds kinds = 0; ///< kinds of the lines in this range; `usemtl` counts as a face
};

/// The result of the first pass over all lines of an OBJ file.
struct ObjSurvey {
    std::vector<ObjStretch> stretches; ///< ranges of lines, about 1 MiB each
    /// Number of lines that are not read, by the name of their data.
    std::map<std::string, std::uint64_t> attributesDropped;
    std::map<std::string, std::uint64_t> unknownKeywords; ///< number of lines per unknown keyword
};

/// Reads all lines of an OBJ file once, in order. Throws Error with path and line at the first line with a defect.
class ObjLines {
public:
    /// Starts the first pass over `file`, which reads each line. The pass fills `survey`, which must be empty, and
    /// reads the material libraries into `materials`.
    ObjLines(const InputFile& file, ObjMaterials& materials, ObjSurvey& survey);

    /// Starts a later pass over `file`, which returns only lines of the kinds `wanted`. It skips ranges of lines in
    /// which the first pass found no such lines.
    ObjLines(const InputFile& file, const ObjMaterials& materials, const ObjSurvey& survey, ObjKinds wanted);

    /// Reads the next line into `line`. Returns false at the end of the file.
    bool next(ObjLine& line);

    /// Returns the place "PATH:LINE" of the current line, for error messages.
    std::string where() const { return text_.where(); }

    /// Returns the number of vertex lines that were read so far.
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
    ObjMaterials* libraries_ = nullptr; // where the first pass stores material libraries; null in later passes
    ObjSurvey* survey_ = nullptr;       // where the first pass stores its result; null in later passes
    std::span<const ObjStretch> stretches_;
    std::size_t stretch_ = 0; // index of the next range of lines
    ObjKinds wanted_ = kAllObjKinds;
    std::uint64_t vertices_ = 0;
    std::uint64_t normals_ = 0;
    std::uint32_t color_ = 0xFFFFFFFF; // RGBA8 colour of the current material
    std::vector<ObjCorner> corners_;
};

} // namespace gnomon::read
