#include "preprocess/read/ply/ply_source.h"

#include "preprocess/read/face_color_splitter.h"
#include "preprocess/read/ply/ply_digits.h"
#include "preprocess/read/ply/ply_face_colors.h"
#include "preprocess/read/ply/ply_fast.h"
#include "preprocess/read/ply/ply_layout.h"
#include "preprocess/read/ply/ply_ranges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

namespace gnomon::read {

namespace {

class PlySource final : public MeshSource {
public:
    PlySource(const std::string& path, const std::vector<std::string>& fields)
        : file_(path), header_(readPlyHeader(file_)), starts_(header_.elements.size() + 1) {
        starts_[0] = {header_.bodyOffset, header_.bodyLine};
        summary_.path = path;
        summary_.fileBytes = file_.size();
        for (std::size_t i = 0; i < header_.elements.size(); ++i)
            addToSummary(i, fields);
        if (vertices_ == header_.elements.size()) throw Error(path, "the header declares no vertices");
        if (!layout_.has(kPosition, 3)) throw Error(path, "the vertices have no x, y and z");
        takeFields(fields);
        requireFaces(summary_);
        summary_.likelyTriangles = likelyTriangles();
        const PlyElement& faces = header_.elements[firstFaces_];
        const bool isOneElement = summary_.stripCount == 0 && summary_.faceCount == faces.count;
        if (isOneElement && !layout_.hasColors) faceColors_ = colorLayoutOf(faces);
        if (layout_.hasColors) findRangeOfVertexColors();
        warnOfDigits();
        if (isOneElement) ranges_.emplace(file_, header_, vertices_, firstFaces_);
        summary_.hasRanges = ranges_.has_value();
    }

    const MeshSummary& summary() const override { return summary_; }

    /// Returns true if the file's faces have colours, all triangles come from such faces, and no vertex has a colour.
    bool hasFaceColors() const { return faceColors_.has_value(); }

    /// Reads the mesh into memory and returns it with its face colours as vertex colours. Throws Error if this needs
    /// more memory than `memoryLimit`.
    std::unique_ptr<MeshSource> withFaceColors(Bytes memoryLimit) {
        FaceColorSplitter splitter(summary_.path, memoryLimit, summary_.fields);
        readVertices([&](const VertexBlock& block) { splitter.addVertices(block); });
        const PlyElement& faces = header_.elements[firstFaces_];
        const ColorRule rule = colorRuleOf(faces, *faceColors_, maximaOfFaceColors());
        pass(
            [&](auto values) {
                readColoredFaces(
                    values, faces, *faceColors_, summary_.vertexCount, [&](auto corners, const auto& channels) {
                        splitter.addFace(corners, colorOf(faces, *faceColors_, rule.full, channels));
                    });
                for (std::size_t i = firstFaces_ + 1; i < header_.elements.size(); ++i)
                    skipElement(values, header_.elements[i], header_.format);
                values.expectEnd();
            },
            firstFaces_);
        file_.requireUnchanged();
        MemoryMesh mesh = splitter.take();
        mesh.attributesDropped.merge(std::map(summary_.attributesDropped));
        mesh.attributesDropped.erase(kFaceColors);
        mesh.remarks = summary_.remarks;
        addRemark(mesh.remarks, rule.remark);
        return memorySource(summary_.path, summary_.fileBytes, std::move(mesh));
    }

    void readVertices(const VertexSink& sink) override {
        pass([&](auto values) { vertexPass(values, sink); }, vertices_);
    }

    void readTriangles(const TriangleSink& sink) override {
        pass([&](auto values) { trianglePass(values, sink); }, firstFaces_);
    }

    std::optional<RowIndex> indexRows(Progress& progress) override {
        requireRanges();
        if (!ranges_->indexRows(progress)) return std::nullopt;
        return RowIndex{{ranges_->index()}};
    }

    void takeRowIndex(const RowIndex& index) override {
        requireRanges();
        if (index.parts.size() != 1)
            throw Error(
                summary_.path,
                "another process reads other input files; start all processes with the same command line");
        ranges_->takeIndex(index.parts.front());
    }

    std::uint64_t triangleCount() const override {
        requireRanges();
        return ranges_->index().triangles;
    }

    void readVertexRange(std::uint64_t begin, std::uint64_t end, const VertexSink& sink) override {
        requireRanges();
        VertexBuffer out(sink, attributes(), begin);
        ranges_->readVertices(begin, end, layout_, out);
    }

    bool readFaceRange(std::uint64_t begin, std::uint64_t end, const TriangleSink& sink) override {
        requireRanges();
        return ranges_->readFaces(begin, end, summary_.vertexCount, sink);
    }

    void pollWith(Progress& progress) override { file_.pollWith(progress); }

    void requireUnchanged() const override { file_.requireUnchanged(); }

    std::string whereIs(std::uint64_t vertex) override {
        PlyElement before = header_.elements[vertices_];
        before.count = vertex;
        std::string where;
        pass(
            [&](auto values) {
                skipElement(values, before, header_.format);
                const PlyProperty& first = before.properties.front();
                values.real(first.isList ? first.countType : first.type);
                where = values.where();
            },
            vertices_);
        return where;
    }

private:
    void requireRanges() const {
        if (!ranges_)
            throw Error(summary_.path, "its rows have different lengths, so they can only be read in sequence");
    }

    void addToSummary(std::size_t i, const std::vector<std::string>& fields) {
        const PlyElement& element = header_.elements[i];
        const Role role = roleOf(element);
        for (const std::string& name : droppedNames(element, role, fields))
            if (element.count > 0) summary_.attributesDropped[name] += element.count;
        if (role == Role::Vertices) {
            if (vertices_ < header_.elements.size()) throw Error(summary_.path, "the header declares vertices twice");
            vertices_ = i;
            layout_ = vertexLayoutOf(element);
            summary_.vertexCount = element.count;
            summary_.hasNormals = layout_.hasNormals;
            summary_.hasColors = layout_.hasColors;
            summary_.isDouble = layout_.isDouble;
        }
        if (role == Role::Faces) summary_.faceCount += element.count;
        if (role == Role::Strips) summary_.stripCount += element.count;
        if (role == Role::Faces || role == Role::Strips) firstFaces_ = std::min(firstFaces_, i);
    }

    void addRemark(std::vector<std::string>& remarks, const std::string& remark) const {
        if (!remark.empty()) remarks.push_back(summary_.path + ": " + remark);
    }

    /// Finds the numeric range of the vertex colours. If the range depends on their max values, the function reads all
    /// vertices.
    void findRangeOfVertexColors() {
        const PlyElement& element = header_.elements[vertices_];
        const ColorLayout colors = *colorLayoutOf(element);
        std::array<double, 4> maxima{};
        if (needsMaxima(element, colors)) {
            VertexLayout scan = layout_;
            scan.hasNormals = scan.hasColors = false;
            for (const int index : colors)
                if (index >= 0) scan.fields.push_back(static_cast<std::size_t>(index));
            const std::size_t count = scan.fields.size();
            const VertexSink sink = [&](const VertexBlock& block) {
                for (std::size_t i = 0; i < block.fields.size(); ++i)
                    if (std::isfinite(block.fields[i]))
                        maxima[i % count] = std::max(maxima[i % count], block.fields[i]);
            };
            pass([&](auto values) { readVerticesAs(values, scan, sink); }, vertices_);
        }
        const ColorRule rule = colorRuleOf(element, colors, maxima);
        layout_.full = rule.full;
        addRemark(summary_.remarks, rule.remark);
    }

    std::array<double, 4> maximaOfFaceColors() {
        const PlyElement& faces = header_.elements[firstFaces_];
        std::array<double, 4> maxima{};
        if (!needsMaxima(faces, *faceColors_)) return maxima;
        pass(
            [&](auto values) {
                readColoredFaces(values, faces, *faceColors_, summary_.vertexCount, [&](auto, const auto& channels) {
                    for (std::size_t i = 0; i < channels.size(); ++i)
                        if (std::isfinite(channels[i].value_or(0)))
                            maxima[i] = std::max(maxima[i], channels[i].value_or(0));
                });
            },
            firstFaces_);
        return maxima;
    }

    /// Adds a warning for the user if float coordinates in the first vertices of an ASCII file have too many digits.
    void warnOfDigits() {
        if (header_.format != PlyFormat::Ascii) return;
        const auto warn = [&](auto values) {
            if constexpr (std::is_same_v<decltype(values), AsciiValues>)
                addRemark(summary_.remarks, warningOfDigits(values, header_.elements[vertices_], layout_));
        };
        pass(warn, vertices_);
    }

    void takeFields(const std::vector<std::string>& names) {
        const PlyElement& element = header_.elements[vertices_];
        const std::vector<std::size_t> known = fieldsOf(element, layout_);
        for (const std::string& name : names) {
            const auto field =
                std::ranges::find_if(known, [&](std::size_t i) { return element.properties[i].name == name; });
            if (std::ranges::count(names, name) > 1)
                throw Error(summary_.path, "a field is requested twice", "each once", name);
            if (field == known.end()) throw Error(summary_.path, "unknown field", listOf(element, known), name);
            layout_.fields.push_back(*field);
            summary_.fields.push_back(name);
        }
    }

    // Estimates the number of triangles. If a binary file has only one list property, all bytes above the min size of
    // the rows are vertex indices.
    std::uint64_t likelyTriangles() const {
        const std::uint64_t ofStrips = summary_.stripCount > 0 ? 2 * summary_.vertexCount : 0;
        std::uint64_t left = summary_.fileBytes - header_.bodyOffset;
        std::uint64_t cornerBytes = 0;
        int lists = 0;
        for (const PlyElement& element : header_.elements) {
            left -= std::min(left, element.count * element.minRowBytes(header_.format));
            for (const PlyProperty& property : element.properties) {
                if (!property.isList) continue;
                cornerBytes = byteSize(property.type);
                ++lists;
            }
        }
        if (lists != 1 || header_.format == PlyFormat::Ascii) return std::max(summary_.faceCount, ofStrips);
        const std::uint64_t corners = left / cornerBytes;
        return std::max(summary_.faceCount, corners - std::min(corners, 2 * summary_.faceCount));
    }

    VertexBuffer::Attributes attributes() const {
        return {.hasNormals = layout_.hasNormals, .hasColors = layout_.hasColors, .fieldCount = layout_.fields.size()};
    }

    // Calls `body` with a reader of values at the start of element `begin`. If the position of this element is unknown,
    // the function first skips the elements before it and stores their positions.
    template <class Body>
    void pass(Body body, std::size_t begin) {
        std::size_t known = begin;
        while (!starts_[known])
            --known;
        const auto walk = [&](auto values) {
            for (std::size_t i = known; i < begin; ++i)
                skip(values, i);
            body(std::move(values));
        };
        if (header_.format == PlyFormat::Ascii)
            walk(AsciiValues(file_, header_.lineEnd, *starts_[known]));
        else
            walk(BinaryValues(file_, header_.format, *starts_[known]));
    }

    template <class Values>
    void skip(Values& values, std::size_t i) {
        skipElement(values, header_.elements[i], header_.format);
        starts_[i + 1] = values.place();
    }

    template <class Values>
    void vertexPass(Values& values, const VertexSink& sink) {
        readVerticesAs(values, layout_, sink);
        starts_[vertices_ + 1] = values.place();
    }

    template <class Values>
    void readVerticesAs(Values& values, const VertexLayout& layout, const VertexSink& sink) {
        const PlyElement& element = header_.elements[vertices_];
        values.beginElement(element);
        VertexBuffer out(
            sink, {.hasNormals = layout.hasNormals, .hasColors = layout.hasColors, .fieldCount = layout.fields.size()});
        readVertexElement(values, element, layout, out);
        out.flush();
    }

    // Reads all triangles and continues to the end of the file. All counts of the header are then verified.
    template <class Values>
    void trianglePass(Values& values, const TriangleSink& sink) {
        TriangleBuffer out(sink);
        for (std::size_t i = firstFaces_; i < header_.elements.size(); ++i) {
            const PlyElement& element = header_.elements[i];
            const Role role = roleOf(element);
            values.beginElement(element);
            if (role == Role::Faces) readFaceElement(values, element, indexListOf(element), summary_.vertexCount, out);
            if (role == Role::Strips) {
                for (std::uint64_t row = 0; row < element.count; ++row)
                    readStripRow(values, element, indexListOf(element), summary_.vertexCount, out);
            }
            if (role == Role::Faces || role == Role::Strips)
                starts_[i + 1] = values.place();
            else
                skip(values, i);
        }
        values.expectEnd();
        out.flush();
        if (out.count() == 0) throw Error(summary_.path, "no triangles: no face has three corners");
    }

    InputFile file_;
    PlyHeader header_;
    VertexLayout layout_;
    MeshSummary summary_;
    std::optional<ColorLayout> faceColors_;
    std::size_t vertices_ = header_.elements.size();   ///< index of the vertex element
    std::size_t firstFaces_ = header_.elements.size(); ///< index of the first element with triangles
    std::optional<PlyRanges> ranges_;                  ///< set if all triangles are in one element
    /// File position of each element, if known. The last entry is the end of the data.
    std::vector<std::optional<PlyPlace>> starts_;
};

} // namespace

std::unique_ptr<MeshSource> openPly(const std::string& path) {
    return std::make_unique<PlySource>(path, std::vector<std::string>());
}

std::unique_ptr<MeshSource> openPlyWithFaceColors(
    const std::string& path, Bytes memoryLimit, const std::vector<std::string>& fields) {
    auto source = std::make_unique<PlySource>(path, fields);
    if (source->hasFaceColors()) return source->withFaceColors(memoryLimit);
    return source;
}

} // namespace gnomon::read
