// The inputs and results of tasks, with the encoding in which they are sent between processes.
#pragma once

#include "preprocess/pipeline/cluster_routing.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/tasks/task.h"

#include <array>
#include <string>

namespace gnomon::pipeline {

/// The data that each task of a chunk or a node needs.
struct TaskFacts {
    hierarchy::Grid grid;
    chunk::VertexFormat format;
};

/// Encode and decode TaskFacts. Decoding throws hierarchy::Damage if the bytes are malformed.
std::vector<std::byte> encoded(const TaskFacts& facts);
TaskFacts decodedFacts(std::span<const std::byte> bytes);

/// The scratch file blocks of a chunk's streams.
struct ChunkStreams {
    std::array<Blocks, static_cast<std::size_t>(chunk::BinStream::Count)> bins;
    std::array<Blocks, static_cast<std::size_t>(chunk::BorderStream::Count)> borders;
};

/// Returns the streams of `chunk`. `borders` is null before the chunks have exchanged shared vertices.
ChunkStreams streamsOfChunk(const scratch::StreamStore& bins, const scratch::StreamStore* borders, std::uint32_t chunk);

/// Encodes the input of TaskKind::AnswerVertices and TaskKind::AnswerNormals. The result of these tasks is Mail for the
/// streams of chunks.
std::vector<std::byte> chunkInput(const ChunkStreams& streams);

/// The input of TaskKind::BuildNode. The result of this task is an encoded NodeRecord.
struct NodeInput {
    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    bool isLast = false; // whether the node is built up to its root
    ChunkStreams chunk;  // only in round 0
    ClusterSums sums;    // totals of the clusters; only in later rounds
    Blocks records;      // records of the clusters; only in later rounds
    Blocks locks;        // locked positions; only in later rounds
};

std::vector<std::byte> encoded(const NodeInput& input);

/// The input of TaskKind::RouteClusters.
struct RouteInput {
    Blocks left; // the clusters without groups of the node, and their ClusterPlaces
    std::uint32_t firstLevel = 0;
    std::uint32_t borderStreams = 0;
    std::vector<std::uint32_t> firstPages;
    std::vector<std::uint32_t> nodeOf;
};

std::vector<std::byte> encoded(const RouteInput& input);

/// The result of TaskKind::RouteClusters and TaskKind::ShareLocks. ShareLocks sets only locks and counts.
struct RoutedMail {
    Mail records;
    Mail locks;
    Mail borders;
    LockCounts counts;
};

RoutedMail decodedRoutedMail(std::span<const std::byte> bytes);

/// Encodes the input of TaskKind::ShareLocks.
std::vector<std::byte> locksInput(const Blocks& borders);

/// The input of TaskKind::WritePages. The result of this task is empty.
struct PageRange {
    std::string path;         // path of the unfinished model file
    std::string displayPath;  // path of the model in error messages
    std::uint64_t offset = 0; // offset of the first page in the model file
    Blocks pages;             // blocks of the scratch file with the pages
};

std::vector<std::byte> encoded(const PageRange& input);

/// Decode the bytes that `chunkInput` and `encoded` returned. The functions throw hierarchy::Damage if the bytes are
/// malformed, or if bytes are left. Only after a chunk other data may follow.
ChunkStreams takeChunk(hierarchy::ByteReader& in);
NodeInput takeNode(hierarchy::ByteReader& in);
RouteInput takeRoute(hierarchy::ByteReader& in);
PageRange takePageRange(hierarchy::ByteReader& in);

std::vector<std::byte> encoded(const RoutedMail& mail);

} // namespace gnomon::pipeline
