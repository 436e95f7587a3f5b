// Generic readers for the rows of a PLY file. They read any layout, value by value. The fast readers in ply_fast.h use
// them for rows that have an unusual layout.
#pragma once

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/color_range.h"
#include "preprocess/read/ply/ply_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gnomon::read {

// The attributes of a vertex are stored in ten slots: three coordinates, three components of the normal, and four
// channels of the colour.
constexpr std::size_t kPosition = 0;
constexpr std::size_t kNormal = 3;
constexpr std::size_t kColor = 6;
constexpr std::size_t kAlpha = 9;
constexpr std::size_t kVertexSlots = 10;

/// Says which property of a PLY element contains each attribute of a vertex.
struct VertexLayout {
    std::array<int, kVertexSlots> property{}; ///< per slot: the property index; -1 if there is none
    bool hasNormals = false;
    bool hasColors = false;
    bool isDouble = false;
    std::vector<std::size_t> fields; ///< indices of the scalar properties that are read as fields
    /// The values that mean full intensity in the channels red, green, blue and alpha.
    std::array<double, 4> full{255, 255, 255, 255};

    /// Returns true if the element has properties for all slots [first, first + count).
    bool has(std::size_t first, std::size_t count) const {
        return std::all_of(
            property.begin() + first, property.begin() + first + count, [](int index) { return index >= 0; });
    }
};

/// Converts a colour channel to a byte. The value `full` becomes 255. The function adds 256 to negative values of type
/// char, because programs that declare char write uchar.
inline std::uint8_t colorByte(PlyType type, double value, double full) {
    return channelByte(type == PlyType::Int8 && value < 0 ? value + 256 : value, full);
}

/// Reads the length of a list. Throws Error if the length is negative or if the rest of the file is too short for the
/// list.
template <class Values>
std::uint64_t readListCount(Values& values, const PlyProperty& list) {
    const std::int64_t count = values.integer(list.countType);
    if (count < 0) throw Error(values.where(), "invalid list count", "none below 0", std::to_string(count));
    const std::uint64_t maxCount = values.maxValues(list.type);
    if (static_cast<std::uint64_t>(count) > maxCount)
        throw Error(
            values.where(),
            "the file ends too early",
            "a list of " + std::to_string(count) + " values in " + values.row(),
            "room for at most " + std::to_string(maxCount));
    return static_cast<std::uint64_t>(count);
}

template <class Values>
void skipProperty(Values& values, const PlyProperty& property) {
    values.skip(property.type, property.isList ? readListCount(values, property) : 1);
}

/// Skips all rows of the PLY element `element`.
template <class Values>
void skipElement(Values& values, const PlyElement& element, PlyFormat format) {
    values.beginElement(element);
    if (element.properties.empty()) return;
    if (!element.hasLists()) {
        const bool isAscii = format == PlyFormat::Ascii;
        return values.skipRows(isAscii ? element.properties.size() : element.minRowBytes(format), element.count);
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
        for (const PlyProperty& property : element.properties)
            skipProperty(values, property);
        values.endRow();
    }
}

/// Skips all faces of a PLY element. Its property `list` contains the vertex indices. Returns the number of triangles
/// of these faces.
template <class Values>
std::uint64_t skipFaces(Values& values, const PlyElement& element, std::size_t list) {
    std::uint64_t triangles = 0;
    values.beginElement(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const std::uint64_t count = property.isList ? readListCount(values, property) : 1;
            values.skip(property.type, count);
            if (i == list && count > 2) triangles += count - 2;
        }
        values.endRow();
    }
    return triangles;
}

/// Returns `value` as a vertex index. Throws Error if the value is negative or at least `vertexCount`.
template <class Values>
std::uint64_t checkedIndex(const Values& values, std::int64_t value, std::uint64_t vertexCount) {
    if (value < 0 || static_cast<std::uint64_t>(value) >= vertexCount)
        throw Error(
            values.where(),
            "vertex index out of range",
            "0 to less than " + std::to_string(vertexCount),
            std::to_string(value));
    return static_cast<std::uint64_t>(value);
}

/// Reads the vertex indices of one polygon into `corners`. Throws Error if an index is out of range or the polygon has
/// more than kMaxPolygonCorners corners.
template <class Values>
void readCorners(
    Values& values, const PlyProperty& list, std::uint64_t vertexCount, std::vector<std::uint64_t>& corners) {
    const std::uint64_t count = readListCount(values, list);
    if (count > kMaxPolygonCorners)
        throw Error(
            values.where(),
            "invalid list count",
            "a polygon of at most " + std::to_string(kMaxPolygonCorners) + " corners",
            std::to_string(count));
    corners.clear();
    for (std::uint64_t i = 0; i < count; ++i)
        corners.push_back(checkedIndex(values, values.integer(list.type), vertexCount));
}

/// Reads one face and adds its triangles to `out`. `corners` is memory that is reused for many faces.
template <class Values>
void readFaceRow(
    Values& values,
    const PlyElement& element,
    int list,
    std::uint64_t vertexCount,
    TriangleBuffer& out,
    std::vector<std::uint64_t>& corners) {
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
        const PlyProperty& property = element.properties[static_cast<std::size_t>(i)];
        if (i == list)
            readCorners(values, property, vertexCount, corners);
        else
            skipProperty(values, property);
    }
    values.endRow();
    out.addPolygon(corners);
}

/// Decodes triangle strips to triangles with consistent winding. A restart index begins a new strip. A triangle with
/// two equal corners only joins two strips, so it is skipped.
class StripDecoder {
public:
    explicit StripDecoder(TriangleBuffer& out) : out_(out) {}

    void restart() { length_ = 0; }

    void add(std::uint64_t index) {
        const bool isOdd = length_ % 2 != 0;
        if (length_ >= 2 && index != first_ && index != second_ && first_ != second_)
            out_.add(isOdd ? TriangleCorners{second_, first_, index} : TriangleCorners{first_, second_, index});
        first_ = second_;
        second_ = index;
        ++length_;
    }

private:
    TriangleBuffer& out_;
    std::uint64_t first_ = 0;
    std::uint64_t second_ = 0;
    std::uint64_t length_ = 0;
};

/// Reads one row of a PLY element with triangle strips, and adds its triangles to `out`. The memory is bounded for
/// strips of any length.
template <class Values>
void readStripRow(Values& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out) {
    StripDecoder strip(out);
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
        const PlyProperty& property = element.properties[static_cast<std::size_t>(i)];
        if (i != list) {
            skipProperty(values, property);
            continue;
        }
        const std::uint64_t count = readListCount(values, property);
        for (std::uint64_t k = 0; k < count; ++k) {
            const std::int64_t index = values.integer(property.type);
            // The restart index is -1. In an unsigned type, it appears as the type's max value.
            const bool isUnsignedRestart = property.type == PlyType::Uint32 && index == 0xFFFFFFFF;
            if (index == -1 || (isUnsignedRestart && vertexCount <= 0xFFFFFFFF))
                strip.restart();
            else
                strip.add(checkedIndex(values, index, vertexCount));
        }
    }
    values.endRow();
}

/// The values of one vertex of a PLY file, stored by attribute and by scalar field.
class VertexRow {
public:
    VertexRow(const PlyElement& element, const VertexLayout& layout)
        : element_(element),
          full_(layout.full),
          slotOf_(element.properties.size(), -1),
          fieldOf_(element.properties.size(), layout.fields.size()),
          fields_(layout.fields.size()) {
        for (std::size_t slot = 0; slot < kVertexSlots; ++slot)
            if (const int i = layout.property[slot]; i >= 0)
                slotOf_[static_cast<std::size_t>(i)] = static_cast<int>(slot);
        for (std::size_t field = 0; field < layout.fields.size(); ++field)
            fieldOf_[layout.fields[field]] = field;
        slots_[kAlpha] = full_[kAlpha - kColor];
    }

    template <class Values>
    void read(Values& values) {
        for (std::size_t i = 0; i < slotOf_.size(); ++i) {
            const PlyProperty& property = element_.properties[i];
            // A scalar field can also be an attribute such as a colour.
            const bool isField = fieldOf_[i] < fields_.size();
            if (slotOf_[i] < 0 && !isField) {
                skipProperty(values, property);
                continue;
            }
            const double value = values.real(property.type);
            if (isField) fields_[fieldOf_[i]] = value;
            if (slotOf_[i] < 0) continue;
            types_[static_cast<std::size_t>(slotOf_[i])] = property.type;
            slots_[static_cast<std::size_t>(slotOf_[i])] = value;
        }
        values.endRow();
    }

    double operator[](std::size_t slot) const { return slots_[slot]; }

    std::uint8_t channel(std::size_t slot) const { return colorByte(types_[slot], slots_[slot], full_[slot - kColor]); }

    const std::vector<double>& fields() const { return fields_; }

private:
    const PlyElement& element_;
    std::array<double, 4> full_;
    std::vector<int> slotOf_;          // per property: its slot; -1 if it has no slot
    std::vector<std::size_t> fieldOf_; // per property: its field; the number of fields if it is no field
    std::array<PlyType, kVertexSlots> types_{};
    std::array<double, kVertexSlots> slots_{};
    std::vector<double> fields_;
};

/// Reads all vertices of a PLY element with any layout, and adds them to `out`.
template <class Values>
void readVertexRows(Values& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    VertexRow row(element, layout);
    for (std::uint64_t n = 0; n < element.count; ++n) {
        row.read(values);
        const VertexBuffer::Rows place = out.append(1);
        place.positions[0] = {row[0], row[1], row[2]};
        if (!place.normals.empty()) {
            const glm::vec3 normal(row[kNormal], row[kNormal + 1], row[kNormal + 2]);
            place.normals[0] = finiteOrZero(normal);
            if (place.normals[0] != normal) out.countBadNormals(1);
        }
        if (!place.colors.empty()) {
            place.colors[0] = 0;
            for (std::uint32_t c = 0; c < 4; ++c)
                place.colors[0] |= std::uint32_t{row.channel(kColor + c)} << (8 * c);
        }
        std::ranges::copy(row.fields(), place.fields.begin());
        out.flushIfFull();
    }
}

} // namespace gnomon::read
