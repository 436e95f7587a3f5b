// What chunks tell each other about the vertices that they share, before each is built by itself.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/binned_source.h"

namespace gnomon::chunk {

/// Writes all streams of BorderStream: first the vertices that chunks asked each other for; then, for those at which a
/// chunk has triangles, the normal (of all faces there, in whichever chunks; only for sources without normals).
/// `atOnce` chunks are worked on at the same time.
void shareBorders(const BinnedSource& source, scratch::StreamStore& borders, std::size_t atOnce, Progress& progress);

} // namespace gnomon::chunk
