// The inputs and results of the tasks that sort a source by ranges of rows. They are encoded as bytes and sent between
// processes.
#pragma once

#include "core/box.h"
#include "hierarchy/model.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/pipeline/tasks/task.h"

#include <vector>

namespace gnomon::pipeline {

/// A range of vertex rows or face rows in the source file.
struct RowRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    Blocks index; // blocks with the row index of the whole source
};

/// The input of TaskKind::CountFaces, which counts triangle corners per vertex.
struct CountInput {
    RowRange faces;
    std::uint64_t maxPages = 1; // max number of vertex pages in memory
};

/// The result of TaskKind::CountFaces: the number of triangle corners per vertex, and an edge sample.
struct FaceCount {
    bool isRegular = false; // whether all faces were readable; if false, all other members are invalid
    std::uint64_t triangles = 0;
    std::uint64_t notAPolygon = 0; // number of faces that are not polygons
    bool hasPolygons = false;
    Mail pages;    // for each page of vertices, corner counts up to 255; a page can occur several times
    Blocks sample; // the sampled edges (entries of an EdgeSample)
};

/// The input of TaskKind::MeasureVertices, which measures bounds and adds up corner counts.
struct MeasureInput {
    RowRange vertices;
    Mail pages;     // corner counts of the vertices in this range
    Blocks sampled; // numbers of the vertices whose positions are requested, ascending
};

/// The result of TaskKind::MeasureVertices: bounds, corner counts and requested positions.
struct VertexMeasure {
    Box box; // bounds of the vertices that triangles use
    std::vector<std::array<double, 2>> fields;
    std::uint64_t badNormals = 0; // number of invalid normals at vertices of the range
    Blocks valence;               // corner counts, one byte per vertex of the range
    Blocks positions;             // positions of the requested vertices (MeasureInput::sampled)
};

/// The grid of a source, and the max grid coordinates of vertices of triangles (`furthest`). Both are known after the
/// vertices have been measured.
struct SortFacts {
    hierarchy::Grid grid;
    hierarchy::GridPoint furthest;
};

/// The input of TaskKind::CountCells, which counts weights of octree cells. The result of this task is a block with
/// CellCounts::openWeights.
struct CellsInput {
    RowRange vertices;
    SortFacts facts;
    Blocks valence;
    Blocks shape; // CellCounts::shape
};

/// The input of TaskKind::BinVertices, which sorts vertices into chunks.
struct BinVerticesInput {
    RowRange vertices;
    SortFacts facts;
    std::vector<hierarchy::Field> fields;
    Blocks valence;
    Blocks tree;
    std::uint64_t blockBytes = 0;
};

/// The input of TaskKind::BinFaces, which sorts faces into chunks.
struct BinFacesInput {
    RowRange faces;
    std::uint32_t chunkCount = 0;
    Blocks chunks;              // for each page of vertices, the chunk of each vertex in 2 or 4 bytes
    std::uint64_t maxPages = 1; // max number of vertex pages in memory
    // Max number of polygon corners in memory, for polygons in several chunks. It is 0 if the source has no polygons.
    std::uint64_t maxCorners = 0;
    std::uint64_t blockBytes = 0;
};

/// The result of TaskKind::BinVertices and TaskKind::BinFaces, which sort vertices and faces into chunks.
struct BinnedRange {
    Mail streams; // blocks to append to the streams of chunks
    std::vector<std::pair<std::uint32_t, chunk::PartSize>> sizes;
    chunk::Strayed strayed; // BinVertices sets only the corners, BinFaces only the triangles
    Blocks chunks;          // only from BinVertices: chunks of the range's vertices, as in BinFacesInput
};

/// Encodes the input or the result of a task as bytes.
std::vector<std::byte> encoded(const read::RowIndex& index);
std::vector<std::byte> encoded(const CountInput& input);
std::vector<std::byte> encoded(const FaceCount& count);
std::vector<std::byte> encoded(const MeasureInput& input);
std::vector<std::byte> encoded(const VertexMeasure& measure);
std::vector<std::byte> encoded(const CellsInput& input);
std::vector<std::byte> encoded(const BinVerticesInput& input);
std::vector<std::byte> encoded(const BinFacesInput& input);
std::vector<std::byte> encoded(const BinnedRange& range);

/// Decodes the bytes that `encoded` returned. The functions throw hierarchy::Damage if the bytes are malformed.
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
