// Messages between chunks about shared vertices. Chunks exchange them before each chunk is built independently.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/binned_source.h"

#include <cstddef>
#include <vector>

namespace gnomon::chunk {

/// Records that one chunk appends to a stream of another chunk.
struct Message {
    std::uint32_t chunk = 0;
    std::vector<std::byte> bytes;
};

/// Messages sorted by ascending chunk.
using Messages = std::vector<Message>;

/// Returns the vertices of `chunk` that other chunks requested, for their streams BorderStream::Vertices.
Messages answerVertices(const BinnedSource& source, std::uint32_t chunk);

/// Returns the normals of shared vertices of `chunk` for the streams BorderStream::Normals of other chunks. A normal
/// includes the faces of all chunks at the vertex. `borders` must contain the stream BorderStream::Vertices of `chunk`.
/// The function is only for sources without normals. It polls `progress`.
Messages answerNormals(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress);

} // namespace gnomon::chunk
