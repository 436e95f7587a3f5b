// The vertices and normals that chunks send to each other before each chunk is built independently.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/binned_source.h"

#include <cstddef>
#include <vector>

namespace gnomon::chunk {

/// Records that one chunk sends to another chunk. The caller appends them to a stream of the receiving chunk.
struct Message {
    std::uint32_t chunk = 0;
    std::vector<std::byte> bytes;
};

/// Messages, sorted by ascending receiving chunk.
using Messages = std::vector<Message>;

/// Returns the vertices of `chunk` that other chunks requested. They are for the streams BorderStream::Vertices of
/// these chunks.
Messages answerVertices(const BinnedSource& source, std::uint32_t chunk);

/// Returns the normals of the vertices of `chunk` that other chunks use. They are for the streams BorderStream::Normals
/// of these chunks. Each normal includes the faces of all chunks at the vertex. `borders` must contain the stream
/// BorderStream::Vertices of `chunk`. The function is only for sources without normals. It polls `progress`.
Messages answerNormals(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
