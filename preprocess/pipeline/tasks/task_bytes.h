// The inputs and results of build tasks, and their encoding as bytes. Processes send these bytes to each other.
#pragma once

#include "preprocess/pipeline/cluster_routing.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/tasks/task.h"

#include <array>
#include <string>

namespace gnomon::pipeline {

/// The grid and the other data that all tasks of chunks and nodes need.
struct TaskFacts {
    hierarchy::Grid grid;
    chunk::VertexFormat format;
};

/// Encodes and decodes TaskFacts. Decoding throws hierarchy::Damage if the bytes are malformed.
std::vector<std::byte> encoded(const TaskFacts& facts);
TaskFacts decodedFacts(std::span<const std::byte> bytes);

/// The byte streams of one chunk, as blocks of the scratch file.
struct ChunkStreams {
    std::array<Blocks, static_cast<std::size_t>(chunk::BinStream::Count)> bins;
    std::array<Blocks, static_cast<std::size_t>(chunk::BorderStream::Count)> borders;
};

/// Returns the streams of `chunk`. `borders` is null until the chunks have exchanged their shared vertices.
ChunkStreams streamsOfChunk(const scratch::StreamStore& bins, const scratch::StreamStore* borders, std::uint32_t chunk);

/// Encodes the input of TaskKind::AnswerVertices and TaskKind::AnswerNormals. These tasks return vertices and normals
/// that other chunks use, as Mail for the streams of these chunks.
std::vector<std::byte> chunkInput(const ChunkStreams& streams);

/// The input of TaskKind::BuildNode, which builds one part of the model (a node). The result of this task is an encoded
/// NodeRecord.
struct NodeInput {
    std::uint32_t round = 0;
    std::uint32_t node = 0;
    std::uint32_t firstLevel = 0;
    bool isLast = false; // whether the node is built up to its root
    ChunkStreams chunk;  // only in round 0
    ClusterSums sums;    // totals of the node's clusters; only in later rounds
    Blocks records;      // records of the node's clusters; only in later rounds
    Blocks locks;        // locked positions of the node; only in later rounds
};

std::vector<std::byte> encoded(const NodeInput& input);

/// The input of TaskKind::RouteClusters, which sends the clusters of a finished node to nodes of the next round.
struct RouteInput {
    Blocks left; // the clusters without groups of the node, and their ClusterPlaces
    std::uint32_t firstLevel = 0;
    std::uint32_t borderStreams = 0;
    std::vector<std::uint32_t> firstPages;
    std::vector<std::uint32_t> nodeOf;
};

std::vector<std::byte> encoded(const RouteInput& input);

/// The result of TaskKind::RouteClusters and TaskKind::ShareLocks, which prepare the next round. ShareLocks sets only
/// the locks and the counts.
struct RoutedMail {
    Mail records;
    Mail locks;
    Mail borders;
    LockCounts counts;
};

RoutedMail decodedRoutedMail(std::span<const std::byte> bytes);

/// Encodes the input of TaskKind::ShareLocks, which finds positions that several nodes share.
std::vector<std::byte> locksInput(const Blocks& borders);

/// The input of TaskKind::WritePages, which writes pages to the model file. The result of this task is empty.
struct PageRange {
    std::string path;         // path of the unfinished model file
    std::string displayPath;  // path of the model in error messages
    std::uint64_t offset = 0; // offset of the first page in the model file
    Blocks pages;             // blocks of the scratch file with the pages
};

std::vector<std::byte> encoded(const PageRange& input);

/// Decodes the bytes that `chunkInput` and `encoded` returned. The functions throw hierarchy::Damage if the bytes are
/// malformed, or if bytes are left. Only after a chunk other data may follow.
ChunkStreams takeChunk(hierarchy::ByteReader& in);
NodeInput takeNode(hierarchy::ByteReader& in);
RouteInput takeRoute(hierarchy::ByteReader& in);
PageRange takePageRange(hierarchy::ByteReader& in);

std::vector<std::byte> encoded(const RoutedMail& mail);

} // namespace gnomon::pipeline
