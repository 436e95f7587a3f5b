// Writing of a known mesh as PLY in any layout, value by value, as reference for the reader.
#pragma once

#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "tests/read/collect.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

namespace gnomon::read {

/// A mesh for the writer. Faces have any number of corners.
struct KnownMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> colors;
    std::vector<std::vector<std::uint64_t>> faces;
};

/// Returns the mesh that a reader must find.
inline CollectedMesh expected(const KnownMesh& mesh) {
    CollectedMesh result;
    result.positions = mesh.positions;
    result.normals = mesh.normals;
    result.colors = mesh.colors;
    for (const auto& face : mesh.faces) {
        if (face.size() < 3) ++result.notAPolygon;
        if (face.size() > 3)
            result.polygons.push_back(
                {static_cast<std::uint32_t>(result.triangles.size()), static_cast<std::uint32_t>(face.size() - 2)});
        for (std::size_t i = 2; i < face.size(); ++i)
            result.triangles.push_back({face[0], face[i - 1], face[i]});
    }
    return result;
}

/// The layout of a PLY file.
struct PlyLayout {
    std::string format = "binary_little_endian"; // or binary_big_endian or ascii
    std::string lineEnd = "\n";
    std::string position = "float";
    std::string normal; // a type, or empty for no normals
    std::string color;  // a type, or empty for no colours
    std::string count = "uchar";
    std::string index = "int";
    bool hasExtras = false; // adds unknown values and lists, and unknown elements before, between and after
    bool facesFirst = false;
};

/// A writer of the values of a PLY file.
class PlyText {
public:
    explicit PlyText(PlyLayout layout) : layout_(std::move(layout)) {}

    void line(const std::string& text) { bytes_ += text + layout_.lineEnd; }

    void value(const std::string& type, double v) {
        if (layout_.format == "ascii") {
            char text[64];
            std::snprintf(text, sizeof text, "%.17g ", v);
            bytes_ += text;
        } else if (type == "char" || type == "int8") {
            raw(static_cast<std::int8_t>(v));
        } else if (type == "uchar" || type == "uint8") {
            raw(static_cast<std::uint8_t>(v));
        } else if (type == "short" || type == "int16") {
            raw(static_cast<std::int16_t>(v));
        } else if (type == "ushort" || type == "uint16") {
            raw(static_cast<std::uint16_t>(v));
        } else if (type == "int" || type == "int32") {
            raw(static_cast<std::int32_t>(v));
        } else if (type == "uint" || type == "uint32") {
            raw(static_cast<std::uint32_t>(v));
        } else if (type == "float" || type == "float32") {
            raw(static_cast<float>(v));
        } else {
            raw(v);
        }
    }

    void endRow() {
        if (layout_.format == "ascii") bytes_ += layout_.lineEnd;
    }

    const std::string& bytes() const { return bytes_; }

private:
    template <class T>
    void raw(T v) {
        char text[sizeof(T)];
        std::memcpy(text, &v, sizeof(T));
        if ((layout_.format == "binary_big_endian") == (std::endian::native == std::endian::little))
            std::reverse(text, text + sizeof(T));
        bytes_.append(text, sizeof(T));
    }

    PlyLayout layout_;
    std::string bytes_;
};

inline void writeExtras(PlyText& out, std::size_t row) {
    out.value("short", static_cast<double>(row % 100));
    out.value("uint8", static_cast<double>(row % 3));
    for (std::size_t i = 0; i < row % 3; ++i)
        out.value("double", 0.5);
}

inline void writeVertices(PlyText& out, const KnownMesh& mesh, const PlyLayout& layout) {
    for (std::size_t row = 0; row < mesh.positions.size(); ++row) {
        for (int axis = 0; axis < 3; ++axis)
            out.value(layout.position, mesh.positions[row][axis]);
        if (layout.hasExtras) writeExtras(out, row);
        for (int axis = 0; axis < 3 && !layout.normal.empty(); ++axis)
            out.value(layout.normal, static_cast<double>(mesh.normals[row][axis]));
        for (unsigned channel = 0; channel < 4 && !layout.color.empty(); ++channel) {
            const double byte = mesh.colors[row] >> (8 * channel) & 255U;
            out.value(layout.color, layout.color.starts_with("f") ? byte / 255 : byte);
        }
        out.endRow();
    }
}

inline void writeFaces(PlyText& out, const KnownMesh& mesh, const PlyLayout& layout) {
    for (std::size_t row = 0; row < mesh.faces.size(); ++row) {
        if (layout.hasExtras) writeExtras(out, row);
        out.value(layout.count, static_cast<double>(mesh.faces[row].size()));
        for (const std::uint64_t corner : mesh.faces[row])
            out.value(layout.index, static_cast<double>(corner));
        if (layout.hasExtras) out.value("double", 7);
        out.endRow();
    }
}

inline void declareExtras(PlyText& out) {
    out.line("property short flag");
    out.line("property list uint8 double weights");
}

inline void declareVertices(PlyText& out, const KnownMesh& mesh, const PlyLayout& layout) {
    out.line("element vertex " + std::to_string(mesh.positions.size()));
    for (const char* name : {"x", "y", "z"})
        out.line("property " + layout.position + " " + name);
    if (layout.hasExtras) declareExtras(out);
    for (const char* name : {"nx", "ny", "nz"})
        if (!layout.normal.empty()) out.line("property " + layout.normal + " " + name);
    for (const char* name : {"red", "green", "blue", "alpha"})
        if (!layout.color.empty()) out.line("property " + layout.color + " " + name);
}

inline void declareFaces(PlyText& out, const KnownMesh& mesh, const PlyLayout& layout) {
    out.line("element face " + std::to_string(mesh.faces.size()));
    if (layout.hasExtras) declareExtras(out);
    out.line("property list " + layout.count + " " + layout.index + " vertex_indices");
    if (layout.hasExtras) out.line("property double quality");
}

inline void declareOther(PlyText& out, const PlyLayout& layout) {
    if (!layout.hasExtras) return;
    out.line("element other 5");
    declareExtras(out);
}

inline void writeOther(PlyText& out, const PlyLayout& layout) {
    for (std::size_t row = 0; row < 5 && layout.hasExtras; ++row) {
        writeExtras(out, row);
        out.endRow();
    }
}

inline std::string plyText(const KnownMesh& mesh, const PlyLayout& layout) {
    PlyText out(layout);
    out.line("ply");
    out.line("format " + layout.format + " 1.0");
    out.line("comment end_header is not here");
    for (const bool isFaces : {layout.facesFirst, !layout.facesFirst}) {
        declareOther(out, layout);
        (isFaces ? declareFaces : declareVertices)(out, mesh, layout);
    }
    declareOther(out, layout);
    out.line("end_header");
    for (const bool isFaces : {layout.facesFirst, !layout.facesFirst}) {
        writeOther(out, layout);
        (isFaces ? writeFaces : writeVertices)(out, mesh, layout);
    }
    writeOther(out, layout);
    return out.bytes();
}

/// Returns a seeded mesh whose coordinates, normals and colours are exact in each type of the layout.
inline KnownMesh randomMesh(std::uint64_t seed, std::size_t vertices, std::size_t faces, const PlyLayout& layout) {
    Random random(seed);
    KnownMesh mesh;
    const bool isWide = layout.position == "double" || layout.position == "float64";
    for (std::size_t i = 0; i < vertices; ++i) {
        const auto coordinate = [&] {
            if (isWide) return random.uniform(-1e7, 1e7);
            if (layout.position == "float") return static_cast<double>(static_cast<float>(random.uniform(-10, 10)));
            return static_cast<double>(random.below(120));
        };
        const double x = coordinate();
        const double y = coordinate();
        mesh.positions.emplace_back(x, y, coordinate());
        if (!layout.normal.empty()) mesh.normals.emplace_back(random.below(2), -1.0F, 0.25F);
        if (!layout.color.empty()) mesh.colors.push_back(static_cast<std::uint32_t>(random.bits()));
    }
    for (std::size_t i = 0; i < faces; ++i) {
        const std::uint64_t kind = random.below(12);
        const std::size_t size = kind < 9 ? 3 : kind == 9 ? 1 + random.below(2) : 4 + random.below(6);
        std::vector<std::uint64_t> face(size);
        for (std::uint64_t& corner : face)
            corner = random.below(vertices);
        mesh.faces.push_back(face);
    }
    mesh.faces.push_back({0, 1, 2});
    return mesh;
}

} // namespace gnomon::read
