// Reads the header of a PLY file: its elements, their properties, and the file position of the data.
#pragma once

#include "preprocess/read/input_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::read {

enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Returns the size in bytes of one value of type `type` in a binary PLY file.
constexpr std::uint32_t byteSize(PlyType type) {
    switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
        return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
        return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
        return 4;
    case PlyType::Float64:
        return 8;
    }
    return 0;
}

constexpr bool isFloat(PlyType type) {
    return type == PlyType::Float32 || type == PlyType::Float64;
}

constexpr const char* nameOf(PlyType type) {
    constexpr const char* kNames[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
    return kNames[static_cast<int>(type)];
}

/// Returns the max value of the integer type `type`. Returns 0 for floating-point types.
constexpr double largestOf(PlyType type) {
    constexpr double kMaxima[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 0, 0};
    return kMaxima[static_cast<int>(type)];
}

/// A property of a PLY element. Each row of the element has one value of the property, or a list of values. The type of
/// a list's length is `countType`.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    bool isList = false;
    PlyType countType = PlyType::Uint8;
};

/// An element of a PLY file, such as "vertex": `count` rows with the same properties.
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Returns the index of the first property with the name `wanted` or `alias`. Returns -1 if no property has such a
    /// name.
    int indexOf(const char* wanted, const char* alias = "") const;

    bool hasLists() const;

    /// Returns the min number of bytes that a row can have. In a binary file, the smallest row has only empty lists. In
    /// an ASCII file, each value has at least one digit and one separator.
    std::uint64_t minRowBytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    std::uint64_t bodyOffset = 0; ///< bytes from the start of the file
    std::uint64_t bodyLine = 1;   ///< line on which the data begin, counted from 1
    char lineEnd = '\n';          ///< '\r' in files of old Macs
};

/// Reads the header of the PLY file `file`. Lines can end with LF, CR LF or CR. Throws Error with the line of an
/// invalid header. Throws Error if the file is too short for the declared counts.
///
/// A line with an unknown keyword before the first element counts as a comment, because Blender has written such lines.
/// It cannot change the layout of the data. After the first element, such a line is an error. Source: Turk, "The PLY
/// Polygon File Format", 1994.
PlyHeader readPlyHeader(const InputFile& file);

} // namespace gnomon::read
