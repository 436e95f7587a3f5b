// A source in chunks, as the binning leaves it.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

namespace gnomon::chunk {

/// Where a source's chunks are.
struct BinnedSource {
    const scratch::StreamStore& bins;
    const hierarchy::Grid& grid;
    VertexFormat format;
    std::uint32_t chunkCount = 0;
};

} // namespace gnomon::chunk
