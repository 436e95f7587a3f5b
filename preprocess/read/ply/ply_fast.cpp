#include "preprocess/read/ply/ply_fast.h"

#include <algorithm>
#include <utility>

namespace gnomon::read {

namespace {

struct Column {
    PlyType type = PlyType::Float32;
    std::uint32_t offset = 0; ///< bytes from the start of the row
    bool isPresent = false;
};

using Columns = std::array<Column, kVertexSlots>;

Columns columnsOf(const PlyElement& element, const VertexLayout& layout) {
    Columns columns;
    std::uint32_t offset = 0;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyType type = element.properties[i].type;
        for (std::size_t slot = 0; slot < kVertexSlots; ++slot)
            if (layout.property[slot] == static_cast<int>(i)) columns[slot] = {type, offset, true};
        offset += byteSize(type);
    }
    return columns;
}

// The bytes of consecutive binary rows of vertices.
struct RawRows {
    const std::byte* bytes;
    std::size_t stride;
    std::size_t count;
    bool isSwapped;
};

template <class T, bool kIsSwapped, class Store>
void decodeAs(const RawRows& rows, const Column& column, Store store) {
    const std::byte* place = rows.bytes + column.offset;
    for (std::size_t i = 0; i < rows.count; ++i, place += rows.stride)
        store(i, loadValue<T>(place, kIsSwapped));
}

template <class T, class Store>
void decodeEither(const RawRows& rows, const Column& column, Store store) {
    if (rows.isSwapped)
        decodeAs<T, true>(rows, column, store);
    else
        decodeAs<T, false>(rows, column, store);
}

// Decodes one attribute of all rows and calls store(row, value) for each row. The switch over the value type is outside
// the loop.
template <class Store>
void decode(const RawRows& rows, const Column& column, Store store) {
    switch (column.type) {
    case PlyType::Int8:
        return decodeEither<std::int8_t>(rows, column, store);
    case PlyType::Uint8:
        return decodeEither<std::uint8_t>(rows, column, store);
    case PlyType::Int16:
        return decodeEither<std::int16_t>(rows, column, store);
    case PlyType::Uint16:
        return decodeEither<std::uint16_t>(rows, column, store);
    case PlyType::Int32:
        return decodeEither<std::int32_t>(rows, column, store);
    case PlyType::Uint32:
        return decodeEither<std::uint32_t>(rows, column, store);
    case PlyType::Float32:
        return decodeEither<float>(rows, column, store);
    case PlyType::Float64:
        return decodeEither<double>(rows, column, store);
    }
}

void decodePositions(const RawRows& rows, const Columns& columns, std::span<glm::dvec3> positions) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        decode(rows, columns[kPosition + axis], [&](std::size_t i, auto value) {
            positions[i][static_cast<int>(axis)] = static_cast<double>(value);
        });
}

/// Decodes the normals of all rows. Normals that are not finite become zero. Returns the number of such normals.
std::uint64_t decodeNormals(const RawRows& rows, const Columns& columns, std::span<glm::vec3> normals) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        decode(rows, columns[kNormal + axis], [&](std::size_t i, auto value) {
            normals[i][static_cast<int>(axis)] = static_cast<float>(value);
        });
    std::uint64_t bad = 0;
    for (glm::vec3& normal : normals) {
        const glm::vec3 stored = std::exchange(normal, finiteOrZero(normal));
        bad += normal != stored ? 1 : 0;
    }
    return bad;
}

void decodeColors(
    const RawRows& rows, const Columns& columns, const std::array<double, 4>& full, std::span<std::uint32_t> colors) {
    std::fill(colors.begin(), colors.end(), columns[kAlpha].isPresent ? 0U : 0xFF000000U);
    for (std::uint32_t channel = 0; channel < 4; ++channel) {
        const Column& column = columns[kColor + channel];
        if (!column.isPresent) continue;
        decode(rows, column, [&](std::size_t i, auto value) {
            colors[i] |= static_cast<std::uint32_t>(colorByte(column.type, static_cast<double>(value), full[channel]))
                         << (8 * channel);
        });
    }
}

void decodeFields(
    const RawRows& rows, const PlyElement& element, const VertexLayout& layout, std::span<double> fields) {
    for (std::size_t field = 0; field < layout.fields.size(); ++field) {
        Column column{element.properties[layout.fields[field]].type, 0, true};
        for (std::size_t before = 0; before < layout.fields[field]; ++before)
            column.offset += byteSize(element.properties[before].type);
        decode(rows, column, [&](std::size_t i, auto value) {
            fields[i * layout.fields.size() + field] = static_cast<double>(value);
        });
    }
}

struct FaceLayout {
    std::size_t before = 0; ///< bytes of the values before the list
    std::size_t after = 0;  ///< bytes of the values after the list
    PlyType countType = PlyType::Uint8;
    bool isSwapped = false;

    std::size_t triangleBytes() const { return before + byteSize(countType) + 3 * sizeof(std::uint32_t) + after; }
};

// Returns the length of a list at `bytes`. A negative length becomes larger than any valid length.
template <PlyType kType>
std::uint32_t loadCount(const std::byte* bytes, bool isSwapped) {
    return withValue(kType, bytes, isSwapped, [](auto value) { return static_cast<std::uint32_t>(value); });
}

// Copies triangles from rows of faces. The function stops at a row that is not a valid triangle, at the end of the
// buffer, or at the end of the bytes. Returns the number of copied triangles.
template <PlyType kCountType, bool kIsSwapped>
std::size_t copyTriangles(
    std::span<const std::byte> bytes,
    const FaceLayout& layout,
    std::uint64_t vertexCount,
    std::span<TriangleCorners> out) {
    const std::size_t stride = layout.triangleBytes();
    const std::size_t count = std::min(bytes.size() / stride, out.size());
    const std::byte* row = bytes.data() + layout.before;
    for (std::size_t i = 0; i < count; ++i, row += stride) {
        const std::byte* corners = row + byteSize(kCountType);
        const TriangleCorners triangle = {
            loadValue<std::uint32_t>(corners, kIsSwapped),
            loadValue<std::uint32_t>(corners + 4, kIsSwapped),
            loadValue<std::uint32_t>(corners + 8, kIsSwapped)};
        const bool isGood = loadCount<kCountType>(row, kIsSwapped) == 3 && triangle[0] < vertexCount &&
                            triangle[1] < vertexCount && triangle[2] < vertexCount;
        if (!isGood) return i;
        out[i] = triangle;
    }
    return count;
}

using CopyTriangles =
    std::size_t (*)(std::span<const std::byte>, const FaceLayout&, std::uint64_t, std::span<TriangleCorners>);

template <PlyType kCountType>
CopyTriangles copyFor(bool isSwapped) {
    return isSwapped ? copyTriangles<kCountType, true> : copyTriangles<kCountType, false>;
}

CopyTriangles copyFor(PlyType countType, bool isSwapped) {
    switch (byteSize(countType)) {
    case 1:
        return copyFor<PlyType::Uint8>(isSwapped);
    case 2:
        return copyFor<PlyType::Uint16>(isSwapped);
    default:
        return copyFor<PlyType::Uint32>(isSwapped);
    }
}

bool isFastFace(const PlyElement& element, std::size_t list) {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].isList != (i == list)) return false;
    const PlyProperty& property = element.properties[list];
    return byteSize(property.type) == 4 && !isFloat(property.type) && !isFloat(property.countType);
}

FaceLayout faceLayoutOf(const PlyElement& element, std::size_t list, bool isSwapped) {
    FaceLayout layout;
    layout.countType = element.properties[list].countType;
    layout.isSwapped = isSwapped;
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (i != list) (i < list ? layout.before : layout.after) += byteSize(element.properties[i].type);
    return layout;
}

} // namespace

void readVertexColumns(BinaryValues& values, const PlyElement& element, const VertexLayout& layout, VertexBuffer& out) {
    const Columns columns = columnsOf(element, layout);
    const std::size_t stride = element.minRowBytes(PlyFormat::BinaryLittleEndian);
    ByteStream& stream = values.stream();
    std::uint64_t done = 0;
    while (done < element.count) {
        if (!stream.fill(stride)) values.throwEndsEarly();
        const auto count = std::min<std::uint64_t>({element.count - done, stream.available() / stride, out.room()});
        const RawRows rows{stream.data(), stride, static_cast<std::size_t>(count), values.isSwapped()};
        const VertexBuffer::Rows place = out.append(rows.count);
        decodePositions(rows, columns, place.positions);
        if (layout.hasNormals) out.countBadNormals(decodeNormals(rows, columns, place.normals));
        if (layout.hasColors) decodeColors(rows, columns, layout.full, place.colors);
        decodeFields(rows, element, layout, place.fields);
        stream.consume(rows.count * stride);
        done += count;
        values.endRows(count);
        out.flushIfFull();
    }
}

void readFaceRows(
    BinaryValues& values, const PlyElement& element, int list, std::uint64_t vertexCount, TriangleBuffer& out) {
    const auto listIndex = static_cast<std::size_t>(list);
    const bool isFast = isFastFace(element, listIndex);
    const FaceLayout layout = faceLayoutOf(element, listIndex, values.isSwapped());
    const CopyTriangles copy = copyFor(layout.countType, layout.isSwapped);
    ByteStream& stream = values.stream();
    std::vector<std::uint64_t> corners;
    std::uint64_t done = 0;
    while (done < element.count) {
        if (isFast && stream.fill(layout.triangleBytes())) {
            const std::span<TriangleCorners> room = out.room();
            const auto maxRows = static_cast<std::size_t>(std::min<std::uint64_t>(element.count - done, room.size()));
            const std::size_t copied =
                copy(std::span(stream.data(), stream.available()), layout, vertexCount, room.first(maxRows));
            stream.consume(copied * layout.triangleBytes());
            done += copied;
            values.endRows(copied);
            out.commit(copied);
            if (copied > 0) continue;
        }
        readFaceRow(values, element, list, vertexCount, out, corners);
        ++done;
    }
}

std::size_t triangleRowBytes(const PlyElement& element, int list) {
    const auto index = static_cast<std::size_t>(list);
    return isFastFace(element, index) ? faceLayoutOf(element, index, false).triangleBytes() : 0;
}

} // namespace gnomon::read
