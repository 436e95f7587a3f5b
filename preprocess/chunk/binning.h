// Sorts the vertices and triangles of a source mesh into chunks, the parts that are built separately. It reads the
// source in several passes in file order, without random access.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/read/mesh_source.h"

namespace gnomon::chunk {

/// Divides the grid of a source mesh into chunks of about `chunkTriangles` triangles each. The function repeats passes
/// over the vertices until no octree cell has too many triangles for a chunk. Throws LimitError if the source needs
/// more than kMaxChunks chunks.
ChunkTree planChunks(
    read::MeshSource& source, const SourceSurvey& survey, std::uint32_t chunkTriangles, Progress& progress);

/// Creates chunks from the weights of octree cells in `counts`. A chunk has at most the weight `limit`. Throws
/// LimitError if the source file `path` needs more than kMaxChunks chunks.
ChunkTree treeOf(const CellCounts& counts, std::uint64_t limit, const std::string& path);

/// The size of the largest chunk, and the number of dropped triangles.
struct BinnedSize {
    // Max number of triangles and max number of vertices over all chunks. Includes the vertices and triangles of other
    // chunks that a chunk needs.
    PartSize largestChunk;
    DroppedTriangles dropped; // triangles that repeat an earlier triangle (HeavyPoints); no chunk contains them
    Strayed strayed;
};

/// Sorts the vertices and triangles of `source` into the chunks of a tree, and writes all streams of BinStream. A
/// vertex belongs to the chunk that contains its snapped position. A triangle belongs to the chunk with most of its
/// corners. If its corners are in three different chunks, it belongs to the median of their numbers. Triangles with the
/// same three positions therefore belong to the same chunk.
///
/// The chunk number of each vertex stays in memory: two bytes per vertex, or four if there are more than 65,535 chunks.
/// No other memory grows with the source. Polygons whose corners are in several chunks are triangulated first. Each
/// pass over the vertices triangulates polygons with about `polygonCorners` corners in total. One more pass writes the
/// used vertices at heavy points, which are grid points with very many triangles. The function frees `survey.valence`.
BinnedSize binSource(
    read::MeshSource& source,
    SourceSurvey& survey,
    const ChunkTree& tree,
    scratch::StreamStore& bins,
    std::size_t polygonCorners,
    Progress& progress);

/// Returns the sizes that `binSource` would return, but writes nothing. The function makes at most two passes over the
/// vertices and one pass over the triangles. If the corners of a polygon are in several chunks, each of these chunks
/// counts all triangles of the polygon. The sizes are then larger than those of `binSource`.
BinnedSize measureBins(read::MeshSource& source, const SourceSurvey& survey, const ChunkTree& tree, Progress& progress);

} // namespace gnomon::chunk
