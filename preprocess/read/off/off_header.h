// The keyword and the counts that an OFF begins with.
#pragma once

#include "preprocess/read/text/text_stream.h"

#include <cstdint>

namespace gnomon::read {

constexpr TextStream::Rules kOffRules{.hasComments = true, .isContinuable = false};

/// What an OFF says of its body.
struct OffHeader {
    bool hasTexture = false;
    bool hasColors = false;
    bool hasNormals = false;
    bool isBinary = false; ///< then counts are in the body
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    std::uint64_t bodyOffset = 0; ///< bytes
    std::uint64_t bodyLine = 0;   ///< lines before the body
};

/// Reads the header of `file`: the keyword, which may be missing or glued to the counts, then the counts over one line
/// or several; the count of edges may be missing. Throws Error with the line, also for counts that the file has no room
/// for.
OffHeader readOffHeader(const InputFile& file);

} // namespace gnomon::read
