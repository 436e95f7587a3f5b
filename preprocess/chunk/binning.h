// Sorts a source mesh into chunks without random access, by passes over its vertices and triangles in file order.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/read/mesh_source.h"

namespace gnomon::chunk {

/// Divides the grid into chunks of about `chunkTriangles` triangles each. The function passes over the vertices until
/// the octree cells are small enough. Throws LimitError if the source needs more than kMaxChunks chunks.
ChunkTree planChunks(
    read::MeshSource& source, const SourceSurvey& survey, std::uint32_t chunkTriangles, Progress& progress);

/// Returns the chunk tree of `counts` with at most `limit` weight per chunk. Throws LimitError with `path` if the tree
/// needs more than kMaxChunks chunks.
ChunkTree treeOf(const CellCounts& counts, std::uint64_t limit, const std::string& path);

/// The sizes of a source in chunks.
struct BinnedSize {
    PartSize largestChunk;    // max triangles and max vertices of a chunk, including records of other chunks
    DroppedTriangles dropped; // repeated triangles between heavy points; no chunk contains them
    Strayed strayed;
};

/// Writes all streams of BinStream. A vertex belongs to the chunk of its snapped position. A triangle belongs to the
/// chunk with most of its corners, or to the median of three chunks. Triangles with the same three positions therefore
/// belong to the same chunk.
///
/// The chunk of each vertex is in memory: two bytes per vertex, or four if there are more than 65,535 chunks. No other
/// memory grows with the source. Polygons in several chunks are triangulated first. Each pass over the vertices
/// triangulates polygons with about `polygonCorners` corners in total. One more pass writes the vertices at heavy
/// points that triangles use. The function frees `survey.valence`.
BinnedSize binSource(
    read::MeshSource& source,
    SourceSurvey& survey,
    const ChunkTree& tree,
    scratch::StreamStore& bins,
    std::size_t polygonCorners,
    Progress& progress);

/// Returns the result of `binSource` without writing. The function makes at most two passes over the vertices and one
/// over the triangles. The sizes are larger than those of `binSource` if polygons lie in several chunks. Each of these
/// chunks then counts all triangles of the polygon.
BinnedSize measureBins(read::MeshSource& source, const SourceSurvey& survey, const ChunkTree& tree, Progress& progress);

} // namespace gnomon::chunk
