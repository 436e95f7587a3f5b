// Reads the header of an OFF file: its keyword and its counts.
#pragma once

#include "preprocess/read/text/text_stream.h"

#include <cstdint>

namespace gnomon::read {

constexpr TextStream::Rules kOffRules{.hasComments = true, .isContinuable = false};

/// The header of an OFF file. It says which attributes the vertices have and where the data begin.
struct OffHeader {
    bool hasTexture = false;
    bool hasColors = false;
    bool hasNormals = false;
    bool isBinary = false; ///< whether the data are binary and contain the counts
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    std::uint64_t bodyOffset = 0; ///< bytes from the start of the file
    std::uint64_t bodyLine = 0;   ///< number of lines before the data
};

/// Reads the header of the OFF file `file`: the keyword and then the counts. The keyword can be missing or joined to
/// the first count. The counts can be on several lines, and the number of edges can be missing. Throws Error with the
/// line of a defect. Throws Error if the file is too short for the counts.
OffHeader readOffHeader(const InputFile& file);

} // namespace gnomon::read
