// The header of a PLY file: its elements, their properties and where the body begins.
#pragma once

#include "preprocess/read/input_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::read {

enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Bytes of one value in a binary body.
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

/// The maximum of a type of integers.
constexpr double largestOf(PlyType type) {
    constexpr double kMaxima[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 0, 0};
    return kMaxima[static_cast<int>(type)];
}

/// One property: a value, or a list with the type of its count.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    bool isList = false;
    PlyType countType = PlyType::Uint8;
};

/// One element: `count` rows of the same properties.
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// The position of the first property with one of two names, or -1.
    int indexOf(const char* wanted, const char* alias = "") const;

    bool hasLists() const;

    /// The fewest bytes that a row takes: binary, all lists empty; ascii, one digit and one separator a value.
    std::uint64_t leastRowBytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    std::uint64_t bodyOffset = 0; ///< bytes
    std::uint64_t bodyLine = 1;   ///< the line the body begins on, counted from 1
    char lineEnd = '\n';          ///< '\r' in files of the old Mac kind
};

/// Reads the header of `file`. Lines may end in LF, CR LF or CR. A line of an unknown keyword before the first element
/// cannot change the layout and is taken for a comment that lost its keyword (Blender has written those); after it, it
/// is an error. Throws Error with the line, also when the file is shorter than the declared counts allow.
/// Source: Turk, "The PLY Polygon File Format", 1994.
PlyHeader readPlyHeader(const InputFile& file);

} // namespace gnomon::read
