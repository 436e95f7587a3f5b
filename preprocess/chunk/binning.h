// Sorts the vertices and triangles of a source mesh into chunks. It reads the source in passes in file order, without
// random access.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/read/mesh_source.h"

namespace gnomon::chunk {

/// Divides the grid into chunks of about `chunkTriangles` triangles each. The function repeats passes over the vertices
/// until no octree cell is too heavy for a chunk. Throws LimitError if the source needs more than kMaxChunks chunks.
ChunkTree planChunks(
    read::MeshSource& source, const SourceSurvey& survey, std::uint32_t chunkTriangles, Progress& progress);

/// Returns the chunk tree for the weights `counts`, with at most `limit` weight per chunk. Throws LimitError, which
/// names `path`, if the tree needs more than kMaxChunks chunks.
ChunkTree treeOf(const CellCounts& counts, std::uint64_t limit, const std::string& path);

/// The sizes of a source after its division into chunks.
struct BinnedSize {
    // max triangles and max vertices of a chunk, including vertices and triangles of other chunks
    PartSize largestChunk;
    DroppedTriangles dropped; // repeated triangles between heavy points (HeavyPoints); no chunk contains them
    Strayed strayed;
};

/// Sorts the vertices and triangles of `source` into chunks and writes all streams of BinStream. A vertex belongs to
/// the chunk of its snapped position. A triangle belongs to the chunk with most of its corners, or to the median of
/// three different chunk numbers. Triangles with the same three positions therefore belong to the same chunk.
///
/// The chunk number of each vertex stays in memory: two bytes per vertex, or four if there are more than 65,535 chunks.
/// No other memory grows with the source. Polygons whose corners are in several chunks are triangulated first. Each
/// pass over the vertices triangulates polygons with about `polygonCorners` corners in total. One more pass writes the
/// vertices at heavy points that triangles use. The function frees `survey.valence`.
BinnedSize binSource(
    read::MeshSource& source,
    SourceSurvey& survey,
    const ChunkTree& tree,
    scratch::StreamStore& bins,
    std::size_t polygonCorners,
    Progress& progress);

/// Returns the sizes that `binSource` would return, but writes nothing. The function makes at most two passes over the
/// vertices and one over the triangles. The sizes are larger than those of `binSource` if the corners of a polygon are
/// in several chunks. Each of these chunks then counts all triangles of the polygon.
BinnedSize measureBins(read::MeshSource& source, const SourceSurvey& survey, const ChunkTree& tree, Progress& progress);

} // namespace gnomon::chunk
