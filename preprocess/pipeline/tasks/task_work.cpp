#include "preprocess/pipeline/tasks/task_work.h"

#include "core/heap.h"
#include "preprocess/chunk/borders.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "preprocess/chunk/covered_faces.h"
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/node.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

/// The byte streams of one chunk, restored from the input of a task.
class OneChunk {
public:
    OneChunk(const ChunkStreams& streams, const TaskFacts& facts, scratch::ScratchFile& scratch)
        : bins_(scratch, chunk::binStreams(1), 1),
          borders_(scratch, chunk::borderStreams(1), 1),
          source_{bins_, facts.grid, facts.format, 1} {
        adopt(bins_, streams.bins);
        adopt(borders_, streams.borders);
    }

    const chunk::BinnedSource& source() const { return source_; }

    const scratch::StreamStore& borders() const { return borders_; }

private:
    template <class Kinds>
    static void adopt(scratch::StreamStore& store, const Kinds& kinds) {
        for (std::uint32_t kind = 0; kind < kinds.size(); ++kind)
            for (const scratch::Block& block : kinds[kind])
                store.adopt(kind, block);
    }

    scratch::StreamStore bins_;
    scratch::StreamStore borders_;
    chunk::BinnedSource source_;
};

levels::OpenClusters openClusters(const NodeInput& input, const TaskFacts& facts, scratch::ScratchFile& scratch) {
    scratch::StreamStore store(scratch, 2, 1);
    for (const scratch::Block& block : input.records)
        store.adopt(0, block);
    for (const scratch::Block& block : input.locks)
        store.adopt(1, block);
    levels::OpenClusterMerger merger(facts.grid, input.sums.clusters, input.sums.vertices, facts.format.fields);
    store.readBlocks(0, [&](std::span<const std::byte> records) { merger.add(records); });
    store.readBlocks(1, [&](std::span<const std::byte> locks) {
        for (const hierarchy::GridPoint& position : levels::positionsFrom(locks))
            merger.lock(position);
    });
    return merger.take();
}

/// Appends the bytes for each stream to the scratch file. Returns the blocks with their stream numbers.
Mail posted(const StreamBytes& messages, scratch::ScratchFile& scratch) {
    Mail mail;
    for (const auto& [stream, bytes] : messages)
        if (!bytes.empty()) mail.emplace_back(stream, scratch.append(bytes));
    return mail;
}

std::uint64_t inputBytes(const NodeInput& input) {
    std::uint64_t sum = 0;
    const auto add = [&](const Blocks& blocks) {
        for (const scratch::Block& block : blocks)
            sum += block.bytes;
    };
    std::for_each(input.chunk.bins.begin(), input.chunk.bins.end(), add);
    add(input.records);
    return sum;
}

/// Appends the pages and clusters of a finished node to the scratch file, and stores their blocks in `record`.
void store(levels::BuiltNode& made, NodeRecord& record, scratch::ScratchFile& scratch) {
    for (levels::NodeLevel& level : made.levels) {
        NodeRecord::LevelOfNode& own = record.levels.emplace_back();
        own.info = level.info;
        for (hierarchy::EncodedPage& page : level.pages) {
            page.info.offset = scratch.append(page.bytes).offset;
            own.pages.push_back(std::move(page.info));
        }
    }
    const std::size_t placeBytes = levels::placeBytes(made.pending.clusters);
    record.places = scratch.append(std::span(made.pending.bytes).first(placeBytes));
    record.clusters = scratch.append(std::span(made.pending.bytes).subspan(placeBytes));
    record.pending = {made.pending.clusters, made.pending.triangles, made.pending.vertices};
    record.rootTriangles = made.rootTriangles;
    record.irreducibleTriangles = made.irreducibleTriangles;
}

} // namespace

std::vector<std::byte> TaskWork::perform(TaskKind kind, std::span<const std::byte> input) const {
    ByteReader in(input);
    scratch_.reopenOthers();
    std::vector<std::byte> result = resultOf(kind, in);
    scratch_.handOver();
    return result;
}

std::vector<std::byte> TaskWork::resultOf(TaskKind kind, ByteReader& in) const {
    switch (kind) {
    case TaskKind::CountFaces:
        return encoded(ranges_.countFaces(takeCountInput(in)));
    case TaskKind::MeasureVertices:
        return encoded(ranges_.measureVertices(takeMeasureInput(in)));
    case TaskKind::CountCells: {
        ByteWriter out;
        putBlocks(out, ranges_.countCells(takeCellsInput(in)));
        return out.take();
    }
    case TaskKind::BinVertices:
        return encoded(ranges_.binVertices(takeBinVerticesInput(in)));
    case TaskKind::BinFaces:
        return encoded(ranges_.binFaces(takeBinFacesInput(in)));
    case TaskKind::AnswerVertices:
    case TaskKind::AnswerNormals:
        return answer(kind, in);
    case TaskKind::BuildNode:
        return buildNode(in);
    case TaskKind::RouteClusters:
        return routeClusters(in);
    case TaskKind::ShareLocks:
        return shareLocks(in);
    case TaskKind::WritePages:
        return writePages(in);
    }
    throw hierarchy::Damage{"a task has an unknown kind"};
}

std::vector<std::byte> TaskWork::answer(TaskKind kind, ByteReader& in) const {
    const OneChunk chunk(takeChunk(in), facts_, scratch_);
    in.expectEnd();
    const chunk::Messages messages = kind == TaskKind::AnswerVertices
                                         ? chunk::answerVertices(chunk.source(), 0)
                                         : chunk::answerNormals(chunk.source(), chunk.borders(), 0, progress_);
    Mail mail;
    for (const chunk::Message& message : messages) // each message has at least one byte
        mail.emplace_back(message.chunk, scratch_.append(message.bytes));
    ByteWriter out;
    putMail(out, mail);
    return out.take();
}

std::vector<std::byte> TaskWork::buildNode(ByteReader& in) const {
    // Min size of a large input in bytes. Building a node of this size takes much longer than trimming the heap.
    constexpr std::uint64_t kLarge = std::uint64_t{4} << 20U;
    const NodeInput input = takeNode(in);
    // This call returns heap fragments of the previous node to the system.
    if (inputBytes(input) > kLarge) returnFreedMemory();
    NodeRecord record;
    record.round = input.round;
    record.node = input.node;
    record.firstLevel = input.firstLevel;
    const levels::NodePlan plan{input.firstLevel, input.isLast ? hierarchy::kNone : kLevelsPerRound};
    levels::BuiltNode made;
    if (input.round == 0) {
        const OneChunk one(input.chunk, facts_, scratch_);
        chunk::ChunkMesh chunk = chunk::loadChunk(one.source(), one.borders(), 0, progress_);
        const std::uint64_t covered = chunk::removeCoveredFaces(chunk.mesh);
        record.dropped = {chunk.dropped.degenerate, chunk.dropped.doubled, chunk.dropped.collapsedByGrid, covered};
        record.bounds = chunk.bounds;
        record.hasNormals = chunk.hasNormals;
        made = levels::buildNode(chunk.mesh, levels::firstLevel(chunk.mesh, options_), plan, options_, progress_);
    } else {
        levels::OpenClusters pending = openClusters(input, facts_, scratch_);
        made = levels::buildNode(pending.mesh, std::move(pending.level), plan, options_, progress_);
    }
    store(made, record, scratch_);
    return encoded(record);
}

std::vector<std::byte> TaskWork::routeClusters(ByteReader& in) const {
    const RouteInput input = takeRoute(in);
    const std::vector<std::byte> bytes = scratch_.read(input.left);
    const RoutedClusters clusters =
        routed({bytes, input.nodeOf, input.firstLevel, input.firstPages}, input.borderStreams);
    return encoded(RoutedMail{
        posted(clusters.records, scratch_),
        posted(clusters.locks, scratch_),
        posted(clusters.borders, scratch_),
        clusters.counts});
}

std::vector<std::byte> TaskWork::writePages(ByteReader& in) const {
    const PageRange range = takePageRange(in);
    File model(range.path, File::Mode::Update, range.displayPath);
    std::uint64_t at = range.offset;
    std::vector<std::byte> bytes;
    for (const scratch::Block& page : range.pages) {
        bytes.resize(page.bytes);
        scratch_.read(page, bytes);
        model.writeAt(at, bytes);
        at += page.bytes;
        progress_.advance(1);
    }
    model.sync();
    return {};
}

std::vector<std::byte> TaskWork::shareLocks(ByteReader& in) const {
    scratch::StreamStore store(scratch_, 1, 1);
    for (const scratch::Block& block : takeBlocks(in))
        store.adopt(0, block);
    in.expectEnd();
    RoutedMail shared;
    shared.locks = posted(sharedBorders(store.readAs<BorderUse>(0), shared.counts), scratch_);
    return encoded(shared);
}

} // namespace gnomon::pipeline
