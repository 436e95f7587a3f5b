// Sorting a source into chunks without random access to it: passes over its vertices and triangles in file order.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/read/mesh_source.h"

namespace gnomon::chunk {

/// Cuts the grid into chunks of about `chunkTriangles` triangles each: passes over the vertices until the cells are
/// small enough. Throws LimitError where that would take more than kMaxChunks chunks.
ChunkTree planChunks(
    read::MeshSource& source, const SourceSurvey& survey, std::uint32_t chunkTriangles, Progress& progress);

/// The tree of `counts` in which a chunk weighs `limit`. Throws LimitError, naming `path`, for more than kMaxChunks.
ChunkTree treeOf(const CellCounts& counts, std::uint64_t limit, const std::string& path);

/// What a source comes to in chunks.
struct BinnedSize {
    PartSize largestChunk;    // the most triangles and the most vertices that a chunk has to deal with
    DroppedTriangles dropped; // that no chunk has, since they repeat others between heavy points of the tree
    Strayed strayed;
};

/// Writes all streams of BinStream. A vertex lies in the chunk of its snapped position; a triangle belongs to the chunk
/// in which most of its corners lie, or to the middle one of three: so triangles of the same three positions always
/// meet. The vertices' chunks are held in memory (two bytes a
/// vertex, four where there are more than 65,535 chunks); nothing else grows with the source. Polygons
/// that lie in several chunks are triangulated first, as many at a time as `polygonCorners` allows, in one pass over
/// the vertices each. Vertices at heavy points of the tree are written in one more pass over the vertices, as far as
/// triangles that are not dropped use them.
/// `survey.valence` is given up.
BinnedSize binSource(
    read::MeshSource& source,
    SourceSurvey& survey,
    const ChunkTree& tree,
    scratch::StreamStore& bins,
    std::size_t polygonCorners,
    Progress& progress);

/// What `binSource` would return, without writing anything: two passes over the vertices at most and one over the
/// triangles. More only where polygons lie in several chunks: each of these counts all triangles of the polygon.
BinnedSize measureBins(read::MeshSource& source, const SourceSurvey& survey, const ChunkTree& tree, Progress& progress);

} // namespace gnomon::chunk
