#include "preprocess/read/obj/obj_source.h"

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/color_range.h"
#include "preprocess/read/obj/obj_lines.h"
#include "preprocess/read/obj/obj_vertices.h"

#include <algorithm>
#include <optional>

namespace gnomon::read {

namespace {

/// The counts and properties of an OBJ file, which the first pass over all lines finds.
struct ObjCounts {
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    std::uint64_t coloredVertices = 0;
    double maxChannel = 0; ///< max channel value of all vertex colours
    std::uint64_t faces = 0;
    std::uint64_t notAPolygon = 0;
    std::uint64_t triangles = 0;
    std::uint64_t vertexEnd = 0; ///< largest vertex index of a face, plus 1
    bool namesNormals = false;
    bool isAligned = true; ///< whether each corner with a normal has the same index for its normal and its vertex
    bool hasFaceColors = false;
};

/// Returns true if the vertex of `corner` must exist in the file. In a face with too few corners, only vertices whose
/// corner has an existing normal (index below `normals`) are used.
bool isLookedUp(const ObjLine& face, const ObjCorner& corner, std::uint64_t normals) {
    return corner.normal < normals || isObjFace(face.corners);
}

class ObjSource final : public MeshSource {
public:
    ObjSource(const std::string& path, Bytes memoryLimit, const std::string& sourceRoot)
        : file_(path), memoryLimit_(memoryLimit), materials_(path, sourceRoot) {
        summary_.path = path;
        summary_.fileBytes = file_.size();
        survey();
        if (counts_.vertexEnd > counts_.vertices) findBadFace();
        requireObjFaces();
        findVertices();
        summary_.vertexCount = vertices_ ? vertices_->count() : counts_.vertices;
        summary_.hasNormals = vertices_ && vertices_->hasNormals();
        summary_.hasColors = hasVertexColors() || counts_.hasFaceColors;
        summary_.heldBytes = survey_.stretches.capacity() * sizeof(ObjStretch) +
                             listedColors_.capacity() * sizeof(std::uint32_t) +
                             (vertices_ ? vertices_->heldBytes() : 0);
        file_.requireUnchanged();
    }

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override {
        VertexBuffer out(sink, {summary_.hasNormals, summary_.hasColors, 0});
        forEachVertex([&](std::uint64_t vertex, const ObjLine& line, const glm::vec3& normal) {
            if (vertices_ && !vertices_->isThere(vertex)) return;
            put(out, line, normal, colorOf(vertex, line, vertices_ ? vertices_->ownColor(vertex) : kNoColor));
        });
        if (vertices_ && !vertices_->variants().empty()) readVariants(out);
        out.flush();
    }

    void readTriangles(const TriangleSink& sink) override {
        TriangleBuffer out(sink);
        if (vertices_) vertices_->begin();
        ObjLines lines(file_, materials_, survey_, kindBit(ObjKind::Face));
        ObjLine line;
        std::vector<std::uint64_t> corners;
        while (lines.next(line)) {
            if (vertices_) {
                out.addPolygon(vertices_->cornersOf(line));
                continue;
            }
            corners.clear();
            for (const ObjCorner& corner : line.corners)
                corners.push_back(corner.vertex);
            out.addPolygon(
                isObjFace(line.corners) ? std::span<const std::uint64_t>(corners) : std::span<const std::uint64_t>());
        }
        out.flush();
    }

    void pollWith(Progress& progress) override { file_.pollWith(progress); }

    void requireUnchanged() const override { file_.requireUnchanged(); }

    std::string whereIs(std::uint64_t vertex) override {
        const std::uint64_t ofFile = vertices_ ? vertices_->ofFile(vertex) : vertex;
        ObjLines lines(file_, materials_, survey_, kindBit(ObjKind::Vertex));
        ObjLine line;
        while (lines.next(line))
            if (lines.vertices() == ofFile + 1) break;
        return lines.where();
    }

private:
    void survey() {
        ObjLines lines(file_, materials_, survey_);
        ObjLine line;
        std::uint64_t badNormals = 0;
        while (lines.next(line)) {
            if (line.kind == ObjKind::Vertex) surveyVertex(line);
            if (line.kind == ObjKind::Normal && finiteOrZero(line.vector) != glm::vec3(line.vector)) ++badNormals;
            if (line.kind == ObjKind::Color) surveyColor(line);
            if (line.kind == ObjKind::Face) surveyFace(line);
        }
        counts_.vertices = lines.vertices();
        counts_.normals = lines.normals();
        counts_.hasFaceColors = materials_.hasColors() && !hasVertexColors();
        summary_.vertexCount = counts_.vertices;
        summary_.faceCount = counts_.faces;
        summary_.likelyTriangles = counts_.triangles;
        summary_.attributesDropped = std::move(survey_.attributesDropped);
        summary_.attributesDropped.merge(materials_.rejected());
        for (const auto& [keyword, count] : survey_.unknownKeywords)
            summary_.attributesDropped["lines of the unknown keyword " + keyword] = count;
        if (badNormals > 0) summary_.attributesDropped[kBadNormals] = badNormals;
        if (materials_.hasColors() && !counts_.hasFaceColors)
            summary_.attributesDropped["colours of materials, beside those of vertices"] = counts_.faces;
        summary_.additionalFiles = materials_.files();
        if (!materials_.remark().empty()) summary_.remarks.push_back(file_.path() + ": " + materials_.remark());
        if (fullOfReals(counts_.maxChannel) != 1)
            summary_.remarks.push_back(
                file_.path() + ": colours of vertices range from 0 to 255, because one exceeds 1");
    }

    /// Throws Error if the file has no faces. The error lists unknown keywords, because a keyword may be misspelt.
    void requireObjFaces() const {
        if (summary_.faceCount > 0 || survey_.unknownKeywords.empty()) return requireFaces(summary_);
        constexpr std::size_t kMaxListed = 8;
        std::string list;
        std::size_t listed = 0;
        for (const auto& [keyword, lines] : survey_.unknownKeywords)
            if (listed++ < kMaxListed) list += " " + keyword;
        throw Error(file_.path(), "no faces", "lines of the keyword f", "lines of unknown keywords:" + list);
    }

    void surveyVertex(const ObjLine& line) {
        summary_.isDouble = summary_.isDouble || glm::dvec3(glm::vec3(line.vector)) != line.vector;
        if (!line.vertexColor) return;
        ++counts_.coloredVertices;
        const glm::dvec3& color = *line.vertexColor;
        counts_.maxChannel = std::max({counts_.maxChannel, color.r, color.g, color.b});
    }

    void surveyColor(const ObjLine& line) {
        listedColors_.push_back(packedChannels(glm::dvec4(line.vector, 1), 1));
        if (listedColors_.size() * sizeof(std::uint32_t) > memoryLimit_.count)
            throw Error(file_.path(), "too many colour lines (vc) for the memory; convert the file to PLY");
    }

    bool hasVertexColors() const { return counts_.coloredVertices > 0 || !listedColors_.empty(); }

    /// Returns the colour of vertex `vertex` from its own line `line`, or else from the `vc` lines. Returns `other` if
    /// both have no colour.
    std::uint32_t colorOf(std::uint64_t vertex, const ObjLine& line, std::uint32_t other) const {
        if (line.vertexColor) return packedChannels(glm::dvec4(*line.vertexColor, full()), full());
        return vertex < listedColors_.size() ? listedColors_[vertex] : other;
    }

    double full() const { return fullOfReals(counts_.maxChannel); }

    void surveyFace(const ObjLine& face) {
        for (const ObjCorner& corner : face.corners) {
            // The argument is kNoNormal because the number of normals is not known yet.
            if (isLookedUp(face, corner, ObjCorner::kNoNormal))
                // The sum of an invalid index and 1 may wrap to 0, so the index itself is compared too.
                counts_.vertexEnd = std::max({counts_.vertexEnd, corner.vertex, corner.vertex + 1});
            if (corner.normal == ObjCorner::kNoNormal) continue;
            counts_.namesNormals = true;
            counts_.isAligned = counts_.isAligned && corner.normal == corner.vertex;
        }
        if (!isObjFace(face.corners)) {
            ++counts_.notAPolygon;
            return;
        }
        ++counts_.faces;
        counts_.triangles += face.corners.size() - 2;
    }

    /// Throws Error with the line of the first face that uses a vertex that does not exist. Does nothing if there is no
    /// such face.
    void findBadFace() {
        ObjLines lines(file_, materials_, survey_, kindBit(ObjKind::Face));
        ObjLine line;
        while (lines.next(line))
            for (const ObjCorner& corner : line.corners)
                if (corner.vertex >= counts_.vertices && isLookedUp(line, corner, counts_.normals))
                    throw Error(
                        lines.where(),
                        "vertex index out of range",
                        "one of " + std::to_string(counts_.vertices) + " vertices",
                        "index " + std::to_string(static_cast<std::int64_t>(corner.vertex)) + " counted from 0");
    }

    void findVertices() {
        if (!(counts_.namesNormals && counts_.normals > 0) && !counts_.hasFaceColors) return;
        const bool isAligned = counts_.isAligned;
        const std::uint64_t needed = counts_.vertices * (isAligned ? 1 : 4) + counts_.vertices * 5 +
                                     (isAligned ? 0 : counts_.normals * sizeof(glm::vec3));
        if (needed > memoryLimit_.count)
            throw Error(
                file_.path(),
                "too large: normals and colours of vertices need memory; convert the file to PLY, which is streamed",
                "at most " + readableBytes(memoryLimit_) + " of memory",
                "a need for up to " + readableBytes({needed}));
        vertices_.emplace(
            ObjVertices::Options{file_.path(), memoryLimit_, counts_.vertices, isAligned, counts_.hasFaceColors},
            isAligned ? std::vector<glm::vec3>() : allNormals(),
            counts_.normals);
        ObjLines lines(file_, materials_, survey_, kindBit(ObjKind::Face));
        ObjLine line;
        while (lines.next(line))
            vertices_->add(line);
        vertices_->finish();
    }

    std::vector<glm::vec3> allNormals() {
        std::vector<glm::vec3> normals;
        normals.reserve(static_cast<std::size_t>(counts_.normals));
        ObjLines lines(file_, materials_, survey_, kindBit(ObjKind::Normal));
        ObjLine line;
        while (lines.next(line))
            normals.push_back(finiteOrZero(line.vector));
        return normals;
    }

    /// Calls `use` for each vertex of the file with its index, its line, and the normal that the first face gives to
    /// it.
    template <class Use>
    void forEachVertex(const Use& use) {
        const bool isAligned = vertices_ && vertices_->hasNormals() && counts_.isAligned;
        ObjLines lines(file_, materials_, survey_, kindBit(ObjKind::Vertex));
        std::optional<ObjLines> normals;
        if (isAligned) normals.emplace(file_, materials_, survey_, kindBit(ObjKind::Normal));
        ObjLine line;
        ObjLine normalLine;
        for (std::uint64_t vertex = 0; lines.next(line); ++vertex) {
            const bool isRead = normals && normals->next(normalLine);
            const std::uint32_t own = vertices_ ? vertices_->ownNormal(vertex) : ObjVertices::kOwn;
            glm::vec3 normal(0);
            if (own != ObjVertices::kOwn) normal = isRead ? finiteOrZero(normalLine.vector) : vertices_->normal(own);
            use(vertex, line, normal);
        }
    }

    void readVariants(VertexBuffer& out) {
        std::size_t next = 0;
        const std::span<const ObjVariant> variants = vertices_->variants();
        forEachVertex([&](std::uint64_t vertex, const ObjLine& line, const glm::vec3& normal) {
            for (; next < variants.size() && variants[next].vertex == vertex; ++next) {
                const ObjVariant& variant = variants[next];
                put(out,
                    line,
                    variant.normal == ObjVertices::kOwn ? normal : vertices_->normal(variant.normal),
                    colorOf(vertex, line, counts_.hasFaceColors ? variant.color : kNoColor));
            }
        });
    }

    void put(VertexBuffer& out, const ObjLine& line, const glm::vec3& normal, std::uint32_t color) const {
        const VertexBuffer::Rows rows = out.append(1);
        rows.positions[0] = line.vector;
        if (summary_.hasNormals) rows.normals[0] = normal;
        if (summary_.hasColors) rows.colors[0] = color;
        out.flushIfFull();
    }

    InputFile file_;
    Bytes memoryLimit_;
    ObjMaterials materials_;
    MeshSummary summary_;
    ObjCounts counts_;
    ObjSurvey survey_;
    std::vector<std::uint32_t> listedColors_; ///< vertex colours of the `vc` lines in file order
    std::optional<ObjVertices> vertices_;
};

} // namespace

std::unique_ptr<MeshSource> openObj(const std::string& path, Bytes memoryLimit, const std::string& sourceRoot) {
    return std::make_unique<ObjSource>(path, memoryLimit, sourceRoot);
}

} // namespace gnomon::read
