// The vertices and normals that chunks of the source mesh send to each other. Afterwards each chunk can be built
// independently.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/binned_source.h"

#include <cstddef>
#include <vector>

namespace gnomon::chunk {

/// Encoded vertices or normals that one chunk sends to the chunk `chunk`. The caller appends the bytes to a stream of
/// the receiving chunk.
struct Message {
    std::uint32_t chunk = 0;
    std::vector<std::byte> bytes;
};

/// A list of messages in ascending order of the receiving chunk.
using Messages = std::vector<Message>;

/// Returns the vertices of `chunk` that other chunks requested. The caller appends them to the streams
/// BorderStream::Vertices of these chunks.
Messages answerVertices(const BinnedSource& source, std::uint32_t chunk);

/// Returns the normals at the vertices of `chunk` that other chunks use. The caller appends them to the streams
/// BorderStream::Normals of these chunks. Each normal includes the faces of all chunks at the vertex. `borders` must
/// contain the stream BorderStream::Vertices of `chunk`. The function is only for sources without normals. It polls
/// `progress`.
Messages answerNormals(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
