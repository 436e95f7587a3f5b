// The inputs and results of the tasks that sort a source by ranges of its rows. They are encoded as bytes for other
// processes.
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
    Blocks index; // blocks with the row index of the whole source
};

/// The input of TaskKind::CountFaces.
struct CountInput {
    RowRange faces;
    std::uint64_t maxPages = 1; // max number of vertex pages in memory
};

/// The result of TaskKind::CountFaces.
struct FaceCount {
    bool isRegular = false; // whether all faces were readable; if false, all following members are invalid
    std::uint64_t triangles = 0;
    std::uint64_t notAPolygon = 0; // number of faces that are not polygons
    bool hasPolygons = false;
    Mail pages;    // per page of vertices: number of corners per vertex, at most 255; a page can occur several times
    Blocks sample; // entries of an EdgeSample
};

/// The input of TaskKind::MeasureVertices.
struct MeasureInput {
    RowRange vertices;
    Mail pages;     // corner counts of the vertices of this range
    Blocks sampled; // ascending numbers of the vertices whose positions are needed
};

/// The result of TaskKind::MeasureVertices.
struct VertexMeasure {
    Box box; // bounds of the vertices that triangles use
    std::vector<std::array<double, 2>> fields;
    std::uint64_t badNormals = 0; // number of invalid normals of all vertices of the range
    Blocks valence;               // one byte per vertex of the range: its corner count
    Blocks positions;             // positions of the vertices in MeasureInput::sampled
};

/// The grid of a source, and `furthest`, the max grid coordinates that triangles use. Both are known after the
/// measurement of the vertices.
struct SortFacts {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest;
};

/// The input of TaskKind::CountCells. The result of this task is a block with CellCounts::openWeights.
struct CellsInput {
    RowRange vertices;
    SortFacts facts;
    Blocks valence;
    Blocks shape; // CellCounts::shape
};

/// The input of TaskKind::BinVertices.
struct BinVerticesInput {
    RowRange vertices;
    SortFacts facts;
    std::vector<hierarchy::Field> fields;
    Blocks valence;
    Blocks tree;
    std::uint64_t blockBytes = 0;
};

/// The input of TaskKind::BinFaces.
struct BinFacesInput {
    RowRange faces;
    std::uint32_t chunkCount = 0;
    Blocks chunks;              // per page of vertices: the chunk of each vertex, in 2 or 4 bytes
    std::uint64_t maxPages = 1; // max number of these pages in memory
    // max number of polygon corners in memory, for polygons in several chunks; 0 without polygons
    std::uint64_t maxCorners = 0;
    std::uint64_t blockBytes = 0;
};

/// The result of TaskKind::BinVertices and TaskKind::BinFaces.
struct BinnedRange {
    Mail streams; // blocks to append to the streams of chunks
    std::vector<std::pair<std::uint32_t, chunk::PartSize>> sizes;
    chunk::Strayed strayed; // BinVertices sets only the corners, BinFaces only the triangles
    Blocks chunks;          // only of BinVertices: chunks of the range's vertices, as in BinFacesInput
};

/// Encode the inputs and results of tasks as bytes.
std::vector<std::byte> encoded(const read::RowIndex& index);
std::vector<std::byte> encoded(const CountInput& input);
std::vector<std::byte> encoded(const FaceCount& count);
std::vector<std::byte> encoded(const MeasureInput& input);
std::vector<std::byte> encoded(const VertexMeasure& measure);
std::vector<std::byte> encoded(const CellsInput& input);
std::vector<std::byte> encoded(const BinVerticesInput& input);
std::vector<std::byte> encoded(const BinFacesInput& input);
std::vector<std::byte> encoded(const BinnedRange& range);

/// Decode the bytes that `encoded` returned. The functions throw hierarchy::Damage if the bytes are malformed.
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
