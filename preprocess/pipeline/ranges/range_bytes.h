// The inputs and results of tasks that sort a source by ranges of its rows, and as bytes.
#pragma once

#include "core/box.h"
#include "hierarchy/model.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/pipeline/tasks/task.h"

#include <vector>

namespace gnomon::pipeline {

/// Rows of a source.
struct RowRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    Blocks index; // of the whole source
};

/// The input of CountFaces.
struct CountInput {
    RowRange faces;
    std::uint64_t mostPages = 1; // of corners at vertices, to hold at once
};

struct FaceCount {
    bool isRegular = false; // they could be read; else nothing else counts
    std::uint64_t triangles = 0;
    std::uint64_t notAPolygon = 0; // faces
    bool hasPolygons = false;
    Mail pages;    // by page of vertices: corners at each, at most 255; a page may come several times
    Blocks sample; // of edges: entries of an EdgeSample
};

/// The input of MeasureVertices.
struct MeasureInput {
    RowRange vertices;
    Mail pages;     // of these
    Blocks sampled; // numbers of vertices whose positions are asked for, ascending
};

struct VertexMeasure {
    Box box; // of those that triangles use
    std::vector<std::array<double, 2>> fields;
    std::uint64_t badNormals = 0; // of all vertices of the range
    Blocks valence;               // a byte for each vertex of the range
    Blocks positions;             // that were asked for
};

/// What is known of a source once it is measured.
struct SortFacts {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest;
};

/// The input of CountCells; the result are the weights of CellCounts, in a block.
struct CellsInput {
    RowRange vertices;
    SortFacts facts;
    Blocks valence;
    Blocks shape; // of the cells
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
    Blocks chunks;               // one for each page of vertices: the number of each vertex's chunk, in 2 bytes or in 4
    std::uint64_t mostPages = 1; // of these, to hold at once
    std::uint64_t mostCorners = 0; // of polygons in several chunks, likewise; 0 where there are no polygons
    std::uint64_t blockBytes = 0;
};

/// The result of both.
struct BinnedRange {
    Mail streams; // of chunks
    std::vector<std::pair<std::uint32_t, chunk::PartSize>> sizes;
    chunk::Strayed strayed; // of BinVertices only the corners, of BinFaces only the triangles
    Blocks chunks;          // of BinVertices: as in BinFacesInput, of the range's vertices
};

std::vector<std::byte> encoded(const read::RowIndex& index);
std::vector<std::byte> encoded(const CountInput& input);
std::vector<std::byte> encoded(const FaceCount& count);
std::vector<std::byte> encoded(const MeasureInput& input);
std::vector<std::byte> encoded(const VertexMeasure& measure);
std::vector<std::byte> encoded(const CellsInput& input);
std::vector<std::byte> encoded(const BinVerticesInput& input);
std::vector<std::byte> encoded(const BinFacesInput& input);
std::vector<std::byte> encoded(const BinnedRange& range);

/// What `encoded` made. Throw hierarchy::Damage.
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
