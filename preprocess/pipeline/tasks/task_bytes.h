// The inputs and results of tasks, and as bytes, in which they travel between processes.
#pragma once

#include "preprocess/pipeline/cluster_routing.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/tasks/task.h"

#include <array>
#include <string>

namespace gnomon::pipeline {

/// What all tasks of a build have in common.
struct TaskFacts {
    hierarchy::Grid grid;
    chunk::VertexFormat format;
};

/// As bytes, for other processes, and back. Throws hierarchy::Damage.
std::vector<std::byte> encoded(const TaskFacts& facts);
TaskFacts decodedFacts(std::span<const std::byte> bytes);

/// The streams of a chunk.
struct ChunkStreams {
    std::array<Blocks, static_cast<std::size_t>(chunk::BinStream::Count)> bins;
    std::array<Blocks, static_cast<std::size_t>(chunk::BorderStream::Count)> borders;
};

/// Those of `chunk` in the stores of all chunks; without `borders` where there are none yet.
ChunkStreams streamsOfChunk(const scratch::StreamStore& bins, const scratch::StreamStore* borders, std::uint32_t chunk);

/// The input of AnswerVertices and of AnswerNormals, whose result is Mail to the streams of chunks.
std::vector<std::byte> chunkInput(const ChunkStreams& streams);

/// The input of BuildNode, whose result is the encoded NodeRecord.
struct NodeInput {
    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    bool isLast = false; // up to the roots
    ChunkStreams chunk;  // in round 0
    ClusterSums sums;    // in later rounds, and ...
    Blocks records;      // ... the clusters ...
    Blocks locks;        // ... and the locked positions
};

std::vector<std::byte> encoded(const NodeInput& input);

/// The input of RouteClusters.
struct RouteInput {
    Blocks left; // by the node: the places of its clusters, and the clusters
    std::uint32_t firstLevel = 0;
    std::uint32_t borderStreams = 0;
    std::vector<std::uint32_t> firstPages;
    std::vector<std::uint32_t> nodeOf;
};

std::vector<std::byte> encoded(const RouteInput& input);

/// The result of RouteClusters, and of ShareLocks, which has no more than locks and counts.
struct RoutedMail {
    Mail records;
    Mail locks;
    Mail borders;
    LockCounts counts;
};

RoutedMail decodedRoutedMail(std::span<const std::byte> bytes);

/// The input of ShareLocks.
std::vector<std::byte> locksInput(const Blocks& borders);

/// The input of WritePages, whose result is empty.
struct PageRange {
    std::string path;         // of the unfinished model, and ...
    std::string toldPath;     // ... how messages name it
    std::uint64_t offset = 0; // there, of the first page
    Blocks pages;             // in the scratch file
};

std::vector<std::byte> encoded(const PageRange& input);

/// What `chunkInput` and `encoded` made, taken from `in`, which must end there but for a chunk. Throws
/// hierarchy::Damage.
ChunkStreams takeChunk(hierarchy::ByteReader& in);
NodeInput takeNode(hierarchy::ByteReader& in);
RouteInput takeRoute(hierarchy::ByteReader& in);
PageRange takePageRange(hierarchy::ByteReader& in);

std::vector<std::byte> encoded(const RoutedMail& mail);

} // namespace gnomon::pipeline
