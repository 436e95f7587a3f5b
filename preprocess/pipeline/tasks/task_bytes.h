// The inputs and results of tasks, with the encoding that transports them between processes.
#pragma once

#include "preprocess/pipeline/cluster_routing.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/tasks/task.h"

#include <array>
#include <string>

namespace gnomon::pipeline {

/// The facts that all tasks of a build share.
struct TaskFacts {
    hierarchy::Grid grid;
    chunk::VertexFormat format;
};

/// Encodes and decodes the facts. Decoding throws hierarchy::Damage if the bytes are malformed.
std::vector<std::byte> encoded(const TaskFacts& facts);
TaskFacts decodedFacts(std::span<const std::byte> bytes);

/// The streams of a chunk.
struct ChunkStreams {
    std::array<Blocks, static_cast<std::size_t>(chunk::BinStream::Count)> bins;
    std::array<Blocks, static_cast<std::size_t>(chunk::BorderStream::Count)> borders;
};

/// Returns the streams of `chunk`. `borders` is null before the border exchange.
ChunkStreams streamsOfChunk(const scratch::StreamStore& bins, const scratch::StreamStore* borders, std::uint32_t chunk);

/// Returns the input of AnswerVertices and AnswerNormals. Their result is Mail to the streams of chunks.
std::vector<std::byte> chunkInput(const ChunkStreams& streams);

/// The input of BuildNode. Its result is the encoded NodeRecord.
struct NodeInput {
    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    bool isLast = false; // builds up to the roots
    ChunkStreams chunk;  // in round 0
    ClusterSums sums;    // in later rounds
    Blocks records;      // clusters, in later rounds
    Blocks locks;        // locked positions, in later rounds
};

std::vector<std::byte> encoded(const NodeInput& input);

/// The input of RouteClusters.
struct RouteInput {
    Blocks left; // remaining clusters of the node and their places
    std::uint32_t firstLevel = 0;
    std::uint32_t borderStreams = 0;
    std::vector<std::uint32_t> firstPages;
    std::vector<std::uint32_t> nodeOf;
};

std::vector<std::byte> encoded(const RouteInput& input);

/// The result of RouteClusters and ShareLocks. ShareLocks sets only locks and counts.
struct RoutedMail {
    Mail records;
    Mail locks;
    Mail borders;
    LockCounts counts;
};

RoutedMail decodedRoutedMail(std::span<const std::byte> bytes);

/// Returns the input of ShareLocks.
std::vector<std::byte> locksInput(const Blocks& borders);

/// The input of WritePages. Its result is empty.
struct PageRange {
    std::string path;         // path of the unfinished model
    std::string displayPath;  // path that messages use
    std::uint64_t offset = 0; // offset of the first page in the file
    Blocks pages;             // blocks of the scratch file
};

std::vector<std::byte> encoded(const PageRange& input);

/// Decode the results of `chunkInput` and `encoded`. Except after a chunk, `in` must end there. They throw
/// hierarchy::Damage if the bytes are malformed.
ChunkStreams takeChunk(hierarchy::ByteReader& in);
NodeInput takeNode(hierarchy::ByteReader& in);
RouteInput takeRoute(hierarchy::ByteReader& in);
PageRange takePageRange(hierarchy::ByteReader& in);

std::vector<std::byte> encoded(const RoutedMail& mail);

} // namespace gnomon::pipeline
