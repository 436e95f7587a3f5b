// What chunks tell each other about the vertices that they share, before each is built by itself.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/binned_source.h"

#include <cstddef>
#include <vector>

namespace gnomon::chunk {

/// Records for a stream of another chunk.
struct Message {
    std::uint32_t chunk = 0;
    std::vector<std::byte> bytes;
};

/// By ascending chunk.
using Messages = std::vector<Message>;

/// What `chunk` appends to the streams BorderStream::Vertices of those that asked it: the vertices that they asked for.
Messages answerVertices(const BinnedSource& source, std::uint32_t chunk);

/// What `chunk`, which has its own stream BorderStream::Vertices in `borders`, appends to the streams
/// BorderStream::Normals: for those at which another has triangles, the normal of all faces there, in whichever chunks.
/// Only for sources without normals. Polls `progress`.
Messages answerNormals(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
