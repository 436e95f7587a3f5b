// The inputs and results of tasks that sort a source by ranges of its rows, with their encoding as bytes.
#pragma once

#include "core/box.h"
#include "hierarchy/model.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/pipeline/tasks/task.h"

#include <vector>

namespace gnomon::pipeline {

/// A range of rows of a source.
struct RowRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    Blocks index; // index of the whole source
};

/// The input of CountFaces.
struct CountInput {
    RowRange faces;
    std::uint64_t maxPages = 1; // max number of vertex pages in memory
};

/// The result of CountFaces.
struct FaceCount {
    bool isRegular = false; // whether all faces were readable; if false, all following members are invalid
    std::uint64_t triangles = 0;
    std::uint64_t notAPolygon = 0; // faces that are not polygons
    bool hasPolygons = false;
    Mail pages;    // per page of vertices: number of corners at each vertex, max 255; a page can occur several times
    Blocks sample; // entries of an EdgeSample
};

/// The input of MeasureVertices.
struct MeasureInput {
    RowRange vertices;
    Mail pages;     // corner counts of these vertices
    Blocks sampled; // ascending vertex numbers whose positions are needed
};

/// The result of MeasureVertices.
struct VertexMeasure {
    Box box; // bounds of the used vertices
    std::vector<std::array<double, 2>> fields;
    std::uint64_t badNormals = 0; // of all vertices of the range
    Blocks valence;               // a byte for each vertex of the range
    Blocks positions;             // that were asked for
};

/// The grid of a source and the max used grid coordinate per axis (`furthest`). The measurement of its vertices finds
/// both.
struct SortFacts {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest;
};

/// The input of CountCells. The result is a block with the weights of CellCounts.
struct CellsInput {
    RowRange vertices;
    SortFacts facts;
    Blocks valence;
    Blocks shape; // shape of the cells
};

/// The input of BinVertices.
struct BinVerticesInput {
    RowRange vertices;
    SortFacts facts;
    std::vector<hierarchy::Field> fields;
    Blocks valence;
    Blocks tree;
    std::uint64_t blockBytes = 0;
};

/// The input of BinFaces.
struct BinFacesInput {
    RowRange faces;
    std::uint32_t chunkCount = 0;
    Blocks chunks;                // one block per page of vertices: the chunk of each vertex, in 2 or 4 bytes
    std::uint64_t maxPages = 1;   // max number of these pages in memory
    std::uint64_t maxCorners = 0; // max number of corners of polygons in several chunks in memory; 0 without polygons
    std::uint64_t blockBytes = 0;
};

/// The result of BinVertices and BinFaces.
struct BinnedRange {
    Mail streams; // blocks for the streams of chunks
    std::vector<std::pair<std::uint32_t, chunk::PartSize>> sizes;
    chunk::Strayed strayed; // BinVertices sets only the corners, BinFaces only the triangles
    Blocks chunks;          // of BinVertices: chunks of the range's vertices, as in BinFacesInput
};

/// Encodes inputs and results as bytes.
std::vector<std::byte> encoded(const read::RowIndex& index);
std::vector<std::byte> encoded(const CountInput& input);
std::vector<std::byte> encoded(const FaceCount& count);
std::vector<std::byte> encoded(const MeasureInput& input);
std::vector<std::byte> encoded(const VertexMeasure& measure);
std::vector<std::byte> encoded(const CellsInput& input);
std::vector<std::byte> encoded(const BinVerticesInput& input);
std::vector<std::byte> encoded(const BinFacesInput& input);
std::vector<std::byte> encoded(const BinnedRange& range);

/// Decode the results of `encoded`. They throw hierarchy::Damage if the bytes are malformed.
read::RowIndex decodedRowIndex(std::span<const std::byte> bytes);
CountInput takeCountInput(hierarchy::ByteReader& in);
FaceCount decodedFaceCount(std::span<const std::byte> bytes);
MeasureInput takeMeasureInput(hierarchy::ByteReader& in);
VertexMeasure decodedMeasure(std::span<const std::byte> bytes);
CellsInput takeCellsInput(hierarchy::ByteReader& in);
BinVerticesInput takeBinVerticesInput(hierarchy::ByteReader& in);
BinFacesInput takeBinFacesInput(hierarchy::ByteReader& in);
BinnedRange decodedBinnedRange(std::span<const std::byte> bytes);

} // namespace gnomon::pipeline
