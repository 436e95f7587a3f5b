#include "preprocess/chunk/field_numbers.h"

#include "core/formatted.h"

#include <algorithm>
#include <cmath>

namespace gnomon::chunk {

namespace {

/// Extends the value ranges of the fields (scalar vertex properties) by the values of one vertex.
void add(
    read::MeshSource& source,
    std::uint64_t vertex,
    std::span<const double> values,
    std::vector<hierarchy::Field>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (!std::isfinite(values[i]))
            throw Error(
                source.whereIs(vertex),
                "field " + fields[i].name + " of vertex " + std::to_string(vertex) + " is not finite");
        fields[i].min = std::min(fields[i].min, values[i]);
        fields[i].max = std::max(fields[i].max, values[i]);
    }
}

} // namespace

std::vector<hierarchy::Field> unmeasuredFields(const read::MeshSummary& source) {
    if (source.fields.size() > hierarchy::kMaxFields)
        throw Error(
            source.path,
            "too many fields",
            "at most " + std::to_string(hierarchy::kMaxFields),
            std::to_string(source.fields.size()));
    std::vector<hierarchy::Field> fields;
    const hierarchy::FieldLayout layout = hierarchy::FieldLayout::of(source.fields.size());
    for (const std::string& name : source.fields)
        fields.push_back({name, HUGE_VAL, -HUGE_VAL, layout.bits[fields.size()]});
    return fields;
}

void addUsed(
    read::MeshSource& source,
    const read::VertexBlock& block,
    const VertexTable<std::uint8_t>& valence,
    std::vector<hierarchy::Field>& fields) {
    for (std::size_t i = 0; !fields.empty() && i < block.positions.size(); ++i)
        if (valence[block.firstVertex + i] > 0)
            add(source, block.firstVertex + i, block.fields.subspan(i * fields.size(), fields.size()), fields);
}

void endRanges(const std::string& path, std::vector<hierarchy::Field>& fields) {
    for (hierarchy::Field& field : fields) {
        if (field.min > field.max) field.min = field.max = 0; // no vertex is used, so the range is empty
        if (!std::isfinite(field.max - field.min))
            throw Error(
                path,
                "the range of field " + field.name + " is too large; do not store this field",
                "max - min below 1.8e308",
                formatted("%g to %g", field.min, field.max));
    }
}

std::vector<hierarchy::Field> measuredFields(
    read::MeshSource& source, const VertexTable<std::uint8_t>& valence, Progress& progress) {
    const read::MeshSummary& summary = source.summary();
    std::vector<hierarchy::Field> fields = unmeasuredFields(summary);
    if (fields.empty()) return fields;
    progress.stage("fields", "vertices", summary.vertexCount);
    source.readVertices([&](const read::VertexBlock& block) {
        addUsed(source, block, valence, fields);
        progress.advance(block.positions.size());
    });
    endRanges(summary.path, fields);
    return fields;
}

std::uint32_t packedFields(std::span<const double> values, std::span<const hierarchy::Field> fields) {
    const hierarchy::FieldLayout layout = hierarchy::FieldLayout::of(fields.size());
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const double range = fields[i].max - fields[i].min;
        const double part = range > 0 ? (values[i] - fields[i].min) / range : 0;
        const double number = std::clamp(part, 0.0, 1.0) * layout.maxNumber(i) + 0.5;
        word |= static_cast<std::uint32_t>(number) << layout.shift(i);
    }
    return word;
}

} // namespace gnomon::chunk
