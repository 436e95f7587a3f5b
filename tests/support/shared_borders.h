// The exchange of borders for tests: one chunk after the other in one process.
#pragma once

#include "preprocess/chunk/borders.h"

namespace gnomon::chunk {

inline void shareBorders(const BinnedSource& source, scratch::StreamStore& borders, Progress& progress) {
    const auto deliver = [&](BorderStream kind, const Messages& messages) {
        for (const Message& message : messages)
            borders.append(streamOf(kind, message.chunk), message.bytes);
    };
    for (std::uint32_t chunk = 0; chunk < source.chunkCount; ++chunk)
        deliver(BorderStream::Vertices, answerVertices(source, chunk));
    borders.flush();
    if (source.format.hasNormals) return;
    for (std::uint32_t chunk = 0; chunk < source.chunkCount; ++chunk)
        deliver(BorderStream::Normals, answerNormals(source, borders, chunk, progress));
    borders.flush();
}

} // namespace gnomon::chunk
