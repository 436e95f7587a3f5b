// Parses the corners of faces in OBJ files.
#pragma once

#include "preprocess/read/text/number.h"

namespace gnomon::read {

/// The indices of a face corner as in the OBJ file. Positive indices count from 1. Negative indices are relative to the
/// last element so far. 0 means that the index is missing.
struct ObjIndices {
    std::int32_t vertex = 0;
    std::int32_t normal = 0;
};

/// Parses a face corner of an OBJ file: V, V/T, V//N or V/T/N. V is required, and no index may be 0. Returns nullopt
/// for other words.
inline std::optional<ObjIndices> cornerIn(std::string_view word) {
    ObjIndices corner;
    for (int part = 0; part < 3; ++part) {
        const std::size_t slash = word.find('/');
        const std::string_view text = word.substr(0, slash);
        const bool mayBeEmpty = part == 1 || (part == 2 && slash == std::string_view::npos);
        const std::int32_t index = integerIn<std::int32_t>(text).value_or(0);
        if (index == 0 && !(text.empty() && mayBeEmpty)) return std::nullopt;
        if (part == 0) corner.vertex = index;
        if (part == 2) corner.normal = index;
        if (slash == std::string_view::npos) return corner;
        word = word.substr(slash + 1);
    }
    return std::nullopt;
}

} // namespace gnomon::read
