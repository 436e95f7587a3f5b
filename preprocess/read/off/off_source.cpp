#include "preprocess/read/off/off_source.h"

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/off/off_binary.h"
#include "preprocess/read/off/off_colors.h"
#include "preprocess/read/off/off_header.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>

namespace gnomon::read {

namespace {

/// How vertices or faces are separated in a text file: one per line, or a fixed number of words for each.
enum class Rows { Lines, Words };

/// One possible interpretation of the lines and words of an OFF text file.
struct Attempt {
    Rows vertices = Rows::Lines;
    Rows faces = Rows::Lines;
    std::size_t channels = 4; ///< number of channels per vertex colour if vertices are not lines
};

/// The interpretations of a text file in the order in which they are tried. If a file has one line per row and colours,
/// the interpretation as a sequence of words fails, because the colours are then read as the next row.
constexpr std::array<Attempt, 6> kAttempts = {{
    {Rows::Lines, Rows::Lines},
    {Rows::Words, Rows::Lines},
    {Rows::Lines, Rows::Words},
    {Rows::Words, Rows::Words},
    {Rows::Words, Rows::Lines, 3},
    {Rows::Words, Rows::Words, 3},
}};

class OffText {
public:
    OffText(const InputFile& file, const OffHeader& header, const Attempt& attempt)
        : file_(file), header_(header), attempt_(attempt), text_(file, kOffRules) {
        text_.moveTo(header.bodyOffset, header.bodyLine);
    }

    MemoryMesh read(Bytes memoryLimit) {
        mesh_.positions.reserve(header_.vertices);
        mesh_.faceSizes.reserve(header_.faces);
        for (std::uint64_t vertex = 0; vertex < header_.vertices; ++vertex)
            readVertex(vertex);
        for (std::uint64_t face = 0; face < header_.faces; ++face)
            readFace(face);
        if (!text_.wordOnAnyLine().empty())
            throw Error(text_.where(), "data after the last face: the counts are too small");
        if (header_.hasTexture && header_.vertices > 0)
            mesh_.attributesDropped["texture coordinates"] = header_.vertices;
        return withOffColors(std::move(mesh_), colors_, header_.hasColors, file_.path(), memoryLimit);
    }

private:
    static constexpr std::size_t kMaxValues = 16; ///< max number of stored values per vertex

    /// The numbers in the text of one vertex: its position and other attributes.
    struct VertexRow {
        std::array<double, kMaxValues> values{};
        std::size_t count = 0; ///< number of values in the file, which can exceed kMaxValues
    };

    /// Reads the numbers of vertex `vertex`. If vertices are not separated by lines, the vertex has `maxValues`
    /// numbers.
    VertexRow readRow(std::uint64_t vertex, std::size_t maxValues) {
        VertexRow row;
        std::string_view word = firstWord(header_.vertices - vertex, header_.faces);
        while (!word.empty()) {
            if (row.count < kMaxValues) row.values[row.count] = text_.numberOf(word);
            ++row.count;
            const bool areLines = attempt_.vertices == Rows::Lines;
            if (!areLines && row.count == maxValues) break;
            word = areLines ? text_.word() : text_.wordOnAnyLine();
        }
        return row;
    }

    void readVertex(std::uint64_t vertex) {
        const std::size_t known = 3U + (header_.hasNormals ? 3 : 0);
        const std::size_t texture = header_.hasTexture ? 2 : 0;
        const VertexRow row = readRow(vertex, known + texture + (header_.hasColors ? attempt_.channels : 0));
        if (row.count < known + texture)
            throw Error(text_.where(), "too few numbers", std::to_string(known + texture), std::to_string(row.count));
        mesh_.positions.emplace_back(row.values[0], row.values[1], row.values[2]);
        if (!isFinite(mesh_.positions.back()) && badLines_.size() < kMaxBadLines) badLines_[vertex] = text_.line();
        if (header_.hasNormals) addNormal({row.values[3], row.values[4], row.values[5]});
        addVertexColor(vertex, row, known, std::min(row.count, kMaxValues) - known - texture);
    }

    /// Adds `count` values of `row`, from the index `first` on, as the colour of a vertex. These values follow the
    /// values that the file's keyword declares.
    void addVertexColor(std::uint64_t vertex, const VertexRow& row, std::size_t first, std::size_t count) {
        const bool isColor = count == 3 || count == 4;
        if (header_.hasColors && count != 0 && !isColor)
            throw Error(
                text_.where(), "bad vertex", "a colour of three or four channels", std::to_string(count) + " values");
        if (isColor)
            colors_.vertices.add(vertex, std::span(row.values).subspan(first, count));
        else if (count > 0)
            ++mesh_.attributesDropped["other values of vertices"];
    }

    void addNormal(const glm::dvec3& normal) {
        mesh_.normals.push_back(finiteOrZero(glm::vec3(normal)));
        if (mesh_.normals.back() != glm::vec3(normal)) ++mesh_.attributesDropped[kBadNormals];
    }

    void readFace(std::uint64_t face) {
        const std::string_view first = firstWord(0, header_.faces - face);
        text_.requireShort(first);
        const auto size = integerIn<std::uint64_t>(first);
        const bool areLines = attempt_.faces == Rows::Lines;
        if (!size || (!areLines && *size < 3))
            throw Error(text_.where(), "bad face", "a number of corners and as many indices", quotedForMessage(first));
        if (*size > kMaxPolygonCorners)
            throw Error(
                text_.where(),
                "the face has too many corners",
                "at most " + std::to_string(kMaxPolygonCorners) + " corners",
                std::to_string(*size));
        for (std::uint64_t i = 0; i < *size; ++i) {
            const std::string_view word = areLines ? text_.word() : text_.wordOnAnyLine();
            if (word.empty())
                throw Error(
                    text_.where(),
                    "bad face",
                    "a number of corners and as many indices",
                    std::to_string(i + 1) + " words");
            mesh_.corners.push_back(checkedCorner(word));
        }
        mesh_.faceSizes.push_back(static_cast<std::uint32_t>(*size));
        if (areLines) readFaceColor(face);
    }

    std::uint64_t checkedCorner(std::string_view word) const {
        const auto index = integerIn<std::int64_t>(word);
        if (!index) text_.requireShort(word);
        if (!index) throw Error(text_.where(), "bad face", "an index", quotedForMessage(word));
        const auto vertex = static_cast<std::uint64_t>(*index);
        if (vertex >= header_.vertices)
            throw Error(
                text_.where(),
                "vertex index out of range",
                "one of " + std::to_string(header_.vertices) + " vertices",
                "index " + std::to_string(*index) + " counted from 0");
        if (!isFinite(mesh_.positions[vertex])) {
            const auto line = badLines_.find(vertex);
            throw Error(
                line == badLines_.end() ? file_.path() : atLine(file_.path(), line->second),
                "a coordinate of vertex " + std::to_string(vertex) + " is not finite");
        }
        return vertex;
    }

    void readFaceColor(std::uint64_t face) {
        std::array<double, 4> values{};
        std::size_t count = 0;
        for (std::string_view word = text_.word(); !word.empty(); word = text_.word(), ++count)
            if (count < values.size()) values[count] = text_.numberOf(word);
        if (count == 3 || count == 4)
            colors_.faces.add(face, std::span(values).first(count));
        else if (count == 1)
            ++mesh_.attributesDropped["face colours by their numbers in a table"];
        else if (count > 0)
            ++mesh_.attributesDropped["other values of faces"];
    }

    /// Returns the first word of the next vertex or face. Throws Error at the end of the file. `vertices` and `faces`
    /// are the numbers of vertices and faces that are still missing.
    std::string_view firstWord(std::uint64_t vertices, std::uint64_t faces) {
        const bool areLines = (vertices > 0 ? attempt_.vertices : attempt_.faces) == Rows::Lines;
        if (areLines && text_.isInLine() && !text_.word().empty())
            throw Error(text_.where(), "more values in a row than the keyword announces");
        const std::string_view word = text_.wordOnAnyLine();
        if (word.empty())
            throw Error(
                text_.where(),
                "the file ends too early",
                std::to_string(vertices) + " more vertices and " + std::to_string(faces) + " more faces",
                "the end");
        return word;
    }

    static constexpr std::size_t kMaxBadLines = 1000;

    const InputFile& file_;
    const OffHeader& header_;
    Attempt attempt_;
    TextStream text_;
    MemoryMesh mesh_;
    OffRowColors colors_;
    std::map<std::uint64_t, std::uint64_t> badLines_; ///< per vertex with a non-finite position: its line
};

MemoryMesh readOffText(const InputFile& file, const OffHeader& header, Bytes memoryLimit) {
    std::optional<Error> first;
    for (const Attempt& attempt : kAttempts) {
        try {
            return OffText(file, header, attempt).read(memoryLimit);
        } catch (const Error& error) {
            if (!first) first = error;
        }
    }
    throw Error(*first);
}

} // namespace

std::unique_ptr<MeshSource> readOff(const std::string& path, Bytes memoryLimit) {
    const InputFile file(path);
    requireRoomForWhole(path, file.size(), memoryLimit);
    const OffHeader header = readOffHeader(file);
    MemoryMesh mesh =
        header.isBinary ? readOffBinary(file, header, memoryLimit) : readOffText(file, header, memoryLimit);
    file.requireUnchanged();
    return memorySource(path, file.size(), std::move(mesh));
}

} // namespace gnomon::read
