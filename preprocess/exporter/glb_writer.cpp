#include "preprocess/exporter/glb_writer.h"

#include "core/box.h"
#include "core/error.h"
#include "core/units.h"
#include "hierarchy/upright_frame.h"
#include "preprocess/exporter/field_value.h"
#include "preprocess/exporter/run_writer.h"
#include "preprocess/exporter/vertex_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

namespace gnomon::exporter {

using namespace hierarchy;
using nlohmann::ordered_json;

namespace {

// Constants of the glTF 2.0 specification (sections 3.6.2.2, 3.6.1 and 4.4).
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kVertices = 34962;
constexpr int kIndices = 34963;

/// Converts an 8-bit sRGB channel value to 16 bits of linear light (IEC 61966-2-1). Different values remain different.
std::uint16_t linearOf(std::uint32_t level) {
    const double display = level / 255.0;
    const double linear = display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(std::lround(linear * 65535));
}

/// Returns the glTF name of the vertex attribute for the scalar field `field`, for example "_QUALITY".
std::string attributeName(const std::string& field) {
    std::string name = "_";
    for (const char c : field) {
        const bool isLower = c >= 'a' && c <= 'z';
        const bool isKept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        name += isLower ? static_cast<char>(c - 'a' + 'A') : isKept ? c : '_';
    }
    return name;
}

/// Describes the data of one glTF buffer view.
struct Content {
    enum Kind { Indices, Positions, Normals, Colors, OfField };

    Kind kind = Indices;
    std::size_t stride = 0; // bytes per element
    std::size_t field = 0;  // index of the scalar field, if the content is a field
};

/// A writer that appends values to a byte array in memory.
struct MemoryWriter {
    std::vector<std::byte> bytes;

    template <class T>
    void putValue(T value) {
        const auto* const begin = reinterpret_cast<const std::byte*>(&value);
        bytes.insert(bytes.end(), begin, begin + sizeof value);
    }
};

class GlbWriter {
public:
    GlbWriter(const CutMesh& mesh, const ModelSummary& summary, const std::optional<GlbTile>& tile)
        : mesh_(mesh), summary_(summary), tile_(tile.value_or(GlbTile())), normals_(mesh, summary) {
        Box bounds;
        for (const Vertex& vertex : mesh.vertices)
            bounds.add(summary.grid.world(vertex.position));
        if (tile || !fitsFloats(mesh, summary.grid)) origin_ = (bounds.min + bounds.max) / 2.0;
    }

    void write(const std::string& path) {
        const std::string text = document(path);
        AtomicFile output(path);
        RunWriter out(output.file());
        out.put("glTF");
        out.putValue(std::uint32_t{2});
        out.putValue(static_cast<std::uint32_t>(28 + text.size() + writtenBytes()));
        out.putValue(static_cast<std::uint32_t>(text.size()));
        out.put("JSON");
        out.put(text);
        out.putValue(static_cast<std::uint32_t>(writtenBytes()));
        out.put(std::string_view("BIN\0", 4));
        if (tile_.isPacked) {
            out.put({reinterpret_cast<const char*>(packed_.data()), packed_.size()});
        } else {
            for (std::size_t view = 0; view < contents_.size(); ++view)
                putView(out, view);
        }
        out.flush();
        output.commit();
    }

private:
    glm::vec3 local(const Vertex& vertex) const { return {summary_.grid.world(vertex.position) - origin_}; }

    /// Adds a glTF buffer view of `count` elements of `type`, and an accessor of this view. Returns the index of the
    /// accessor.
    std::size_t add(const Content& content, std::uint64_t count, const char* type, int component) {
        const std::uint64_t bytesEach = content.stride;
        const int target = content.kind == Content::Indices ? kIndices : kVertices;
        contents_.push_back(content);
        views_.push_back(
            {{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", count * bytesEach}, {"target", target}});
        accessors_.push_back(
            {{"bufferView", views_.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
        bytes_ += count * bytesEach;
        return accessors_.size() - 1;
    }

    ordered_json primitive() {
        const std::uint64_t vertices = mesh_.vertices.size();
        const std::size_t indices = add({Content::Indices, 4}, mesh_.triangles.size() * 3, "SCALAR", kUnsignedInt);
        ordered_json attributes;
        const std::size_t positions = add({Content::Positions, 12}, vertices, "VEC3", kFloat);
        attributes["POSITION"] = positions;
        glm::vec3 low(std::numeric_limits<float>::infinity());
        glm::vec3 high = -low;
        for (const Vertex& vertex : mesh_.vertices) {
            low = glm::min(low, local(vertex));
            high = glm::max(high, local(vertex));
        }
        accessors_[positions]["min"] = {low.x, low.y, low.z};
        accessors_[positions]["max"] = {high.x, high.y, high.z};
        if (summary_.hasNormals) attributes["NORMAL"] = add({Content::Normals, 12}, vertices, "VEC3", kFloat);
        if (summary_.hasColors) {
            const std::size_t colors = add({Content::Colors, 8}, vertices, "VEC4", kUnsignedShort);
            accessors_[colors]["normalized"] = true;
            attributes["COLOR_0"] = colors;
        }
        for (std::size_t i = 0; i < summary_.fields.size(); ++i)
            attributes[attributeName(summary_.fields[i].name)] =
                add({Content::OfField, 4, i}, vertices, "SCALAR", kFloat);
        return {{"attributes", attributes}, {"indices", indices}, {"material", 0}};
    }

    /// Returns the matrix of the glTF node in column-major order. The matrix rotates the up axis to +y, converts the
    /// unit to metres, and adds the origin.
    ordered_json matrix() const {
        const UprightFrame upright = uprightFrame(summary_.up.direction);
        const double metres = rowOf(summary_.unit).metres;
        ordered_json values = ordered_json::array();
        const auto put = [&](const glm::dvec3& column, int last) {
            for (int i = 0; i < 3; ++i)
                values.push_back(column[i]);
            values.push_back(last);
        };
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 unit(0);
            unit[axis] = metres;
            put(upright.toUpright(unit), 0);
        }
        put(metres * upright.toUpright(origin_ - tile_.anchor), 1);
        return values;
    }

    /// Returns the JSON chunk of the .glb file with its padding. The JSON contains the size of the binary chunk that
    /// follows.
    std::string document(const std::string& path) {
        const ordered_json triangles = primitive();
        if (tile_.isPacked) pack();
        ordered_json node = {{"mesh", 0}, {"matrix", matrix()}};
        const ordered_json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        if (node["matrix"] == identity) node.erase("matrix");
        ordered_json all = {
            {"asset", {{"version", "2.0"}, {"generator", "gnomon"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", ordered_json::array({node})},
            {"meshes", {{{"primitives", ordered_json::array({triangles})}}}},
            {"materials",
             {{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}, {"doubleSided", true}}}},
            {"accessors", accessors_},
            {"bufferViews", views_},
            {"buffers", {{{"byteLength", writtenBytes()}}}}};
        if (tile_.isPacked) {
            // The extension EXT_meshopt_compression requires a fallback buffer. In this file, the buffer has no data.
            all["buffers"].push_back(
                {{"byteLength", bytes_}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
            all["extensionsUsed"] = all["extensionsRequired"] = {"EXT_meshopt_compression"};
        }
        std::string text = all.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint64_t whole = 28 + text.size() + writtenBytes();
        if (whole > std::numeric_limits<std::uint32_t>::max())
            throw Error(
                path,
                "too large for one .glb: write fewer triangles, or a PLY",
                "less than 4 GiB",
                readableBytes({whole}));
        return text;
    }

    /// Writes the data of the buffer view with the index `view` to a file or to memory.
    template <class Out>
    void putView(Out& out, std::size_t view) const {
        const auto putVector = [&](const glm::vec3& v) {
            for (int i = 0; i < 3; ++i)
                out.putValue(v[i]);
        };
        switch (contents_[view].kind) {
        case Content::Indices:
            for (const auto& triangle : mesh_.triangles)
                for (const std::uint32_t corner : triangle)
                    out.putValue(corner);
            break;
        case Content::Positions:
            for (const Vertex& vertex : mesh_.vertices)
                putVector(local(vertex));
            break;
        case Content::Normals:
            for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
                putVector(normals_[v]);
            break;
        case Content::Colors:
            for (const Vertex& vertex : mesh_.vertices)
                putColor(out, vertex.color);
            break;
        case Content::OfField:
            putField(out, contents_[view].field);
        }
    }

    template <class Out>
    static void putColor(Out& out, std::uint32_t color) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t level = color >> 8 * i & 255U;
            out.putValue(i < 3 ? linearOf(level) : static_cast<std::uint16_t>(level * 257));
        }
    }

    template <class Out>
    void putField(Out& out, std::size_t field) const {
        for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v)
            out.putValue(
                static_cast<float>(fieldValue(summary_.fields[field], mesh_.fields.layout, mesh_.fieldsOf(v), field)));
    }

    /// Compresses the data of all buffer views into one buffer. Each view starts at a multiple of 4 bytes.
    void pack() {
        for (std::size_t view = 0; view < contents_.size(); ++view) {
            MemoryWriter raw;
            const std::size_t stride = contents_[view].stride;
            raw.bytes.reserve(views_[view]["byteLength"].get<std::size_t>());
            putView(raw, view);
            const std::size_t count = raw.bytes.size() / stride;
            const bool isOfIndices = contents_[view].kind == Content::Indices;
            std::vector<unsigned char> bytes(
                isOfIndices ? meshopt_encodeIndexBufferBound(count, mesh_.vertices.size())
                            : meshopt_encodeVertexBufferBound(count, stride));
            const auto* const indices = reinterpret_cast<const std::uint32_t*>(raw.bytes.data());
            bytes.resize(
                isOfIndices ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices, count)
                            : meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), raw.bytes.data(), count, stride));
            views_[view]["buffer"] = 1;
            if (!isOfIndices) views_[view]["byteStride"] = stride;
            views_[view]["extensions"]["EXT_meshopt_compression"] = {
                {"buffer", 0},
                {"byteOffset", packed_.size()},
                {"byteLength", bytes.size()},
                {"byteStride", stride},
                {"mode", isOfIndices ? "TRIANGLES" : "ATTRIBUTES"},
                {"count", count}};
            packed_.insert(packed_.end(), bytes.begin(), bytes.end());
            packed_.resize((packed_.size() + 3) / 4 * 4);
        }
    }

    std::uint64_t writtenBytes() const { return tile_.isPacked ? packed_.size() : bytes_; }

    const CutMesh& mesh_;
    const ModelSummary& summary_;
    GlbTile tile_;
    VertexNormals normals_;
    glm::dvec3 origin_{0};
    std::uint64_t bytes_ = 0;       // size of the binary buffer
    std::vector<Content> contents_; // one entry per buffer view
    std::vector<unsigned char> packed_;
    ordered_json views_ = ordered_json::array();
    ordered_json accessors_ = ordered_json::array();
};

} // namespace

void writeGlb(
    const CutMesh& mesh,
    const ModelSummary& summary,
    const std::string& path,
    Progress& progress,
    const std::optional<GlbTile>& tile) {
    progress.stage("write", "triangles", mesh.triangles.size());
    GlbWriter(mesh, summary, tile).write(path);
    progress.advance(mesh.triangles.size());
}

} // namespace gnomon::exporter
