// A source mesh whose vertices and triangles are sorted into chunks. A chunk is a part of the mesh that is built
// separately.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

namespace gnomon::chunk {

/// A source mesh sorted into chunks: the byte streams of its chunks, the grid, and the format of the vertex records.
struct BinnedSource {
    const scratch::StreamStore& bins;
    const hierarchy::Grid& grid;
    VertexFormat format;
    std::uint32_t chunkCount = 0;
};

} // namespace gnomon::chunk
