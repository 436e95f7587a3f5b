#include "preprocess/exporter/ply_writer.h"

#include "core/error.h"
#include "preprocess/exporter/field_value.h"
#include "preprocess/exporter/run_writer.h"
#include "preprocess/exporter/vertex_normals.h"

#include <algorithm>
#include <cmath>

namespace gnomon::exporter {

using namespace hierarchy;

namespace {

/// Returns true if 32-bit floats distinguish all quantised values of a scalar field.
bool fitsFloats(const Field& field) {
    const double step = (field.max - field.min) / ((1U << field.bits) - 1U);
    return std::max(std::abs(field.min), std::abs(field.max)) * 0x1p-24 <= step / 64;
}

/// Throws Error if the name of a scalar field is invalid in a PLY header or occurs twice. The names come from the model
/// file and can be any text.
void requirePlyNames(const std::string& model, const std::vector<Field>& fields, std::span<const VertexValues> values) {
    for (const Field& field : fields) {
        for (const VertexValues& property : values)
            if (property.name == field.name)
                throw Error(model, "the model has two fields with this name: " + field.name);
        if (!std::ranges::all_of(field.name, [](char c) { return c > ' ' && c < 0x7F; }))
            throw Error(
                model,
                "a field cannot become a PLY property, because of its name",
                "letters without blanks",
                field.name);
    }
}

std::string headerOf(
    const CutMesh& mesh, const ModelSummary& summary, std::span<const VertexValues> values, bool asFloats) {
    const std::string real = asFloats ? "float" : "double";
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment gnomon export\nelement vertex " +
                       std::to_string(mesh.vertices.size()) + "\n";
    for (const char* axis : {"x", "y", "z"})
        text += "property " + real + " " + axis + "\n";
    if (summary.hasNormals) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (summary.hasColors)
        text += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
    for (const Field& field : summary.fields)
        text += (fitsFloats(field) ? "property float " : "property double ") + field.name + "\n";
    for (const VertexValues& property : values)
        text += "property float " + property.name + "\n";
    return text + "element face " + std::to_string(mesh.triangles.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

void putPosition(RunWriter& out, const glm::dvec3& p, bool asFloats) {
    for (int axis = 0; axis < 3; ++axis) {
        if (asFloats)
            out.putValue(static_cast<float>(p[axis]));
        else
            out.putValue(p[axis]);
    }
}

void putFields(RunWriter& out, std::uint32_t word, const ModelSummary& summary, const FieldLayout& layout) {
    for (std::size_t i = 0; i < summary.fields.size(); ++i) {
        const Field& field = summary.fields[i];
        const double value = fieldValue(field, layout, word, i);
        if (fitsFloats(field))
            out.putValue(static_cast<float>(value));
        else
            out.putValue(value);
    }
}

} // namespace

void writePly(
    const CutMesh& mesh,
    const ModelSummary& summary,
    std::span<const VertexValues> values,
    const std::string& path,
    Progress& progress) {
    requirePlyNames(path, summary.fields, values);
    AtomicFile output(path);
    RunWriter out(output.file());
    const bool asFloats = fitsFloats(mesh, summary.grid);
    const VertexNormals normals(mesh, summary);
    progress.stage("write", "triangles", mesh.triangles.size());
    out.put(headerOf(mesh, summary, values, asFloats));
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vertex& vertex = mesh.vertices[v];
        putPosition(out, summary.grid.world(vertex.position), asFloats);
        for (int axis = 0; axis < 3 && summary.hasNormals; ++axis)
            out.putValue(normals[v][axis]);
        if (summary.hasColors) out.putValue(vertex.color);
        putFields(out, mesh.fieldsOf(v), summary, mesh.fields.layout);
        for (const VertexValues& property : values)
            out.putValue(property.values[v]);
    }
    for (const auto& triangle : mesh.triangles) {
        out.putValue(std::uint8_t{3});
        for (const std::uint32_t corner : triangle)
            out.putValue(static_cast<std::int32_t>(corner));
    }
    out.flush();
    progress.advance(mesh.triangles.size());
    output.commit();
}

} // namespace gnomon::exporter
