#include "preprocess/pipeline/checkpoint_log.h"

#include "core/check.h"
#include "hierarchy/file_layout.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/levels/page_layout.h"
#include "preprocess/scratch/parted_scratch.h"

#include <algorithm>
#include <bit>

namespace gnomon::pipeline {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;
using hierarchy::LevelInfo;
using hierarchy::PageInfo;

enum class Kind : std::uint8_t { Binned, Bordered, Round, Node };

/// Encodes the members of a record. Taker decodes the same members in the same order.
struct Putter {
    ByteWriter& out;

    template <class T>
    void field(const T& value) {
        if constexpr (std::is_integral_v<T>)
            out.putVarint(static_cast<std::uint64_t>(value));
        else
            out.putVarint(std::bit_cast<std::uint64_t>(value));
    }

    template <class T>
    void count(const std::vector<T>& values) {
        out.putVarint(values.size());
    }

    void bytes(const std::vector<std::byte>& values) {
        count(values);
        out.put(values);
    }

    void text(const std::string& value) { out.putText(value); }

    void block(const scratch::Block& value) { scratch::putBlock(out, value); }
};

struct Taker {
    ByteReader& in;

    template <class T>
    void field(T& value) {
        if constexpr (std::is_integral_v<T>)
            value = static_cast<T>(in.takeVarint());
        else
            value = std::bit_cast<T>(in.takeVarint());
    }

    template <class T>
    void count(std::vector<T>& values) {
        const std::uint64_t count = in.takeVarint();
        // Each element has at least one byte, so a larger count means damaged bytes.
        if (count > in.remaining()) throw hierarchy::Damage{"the bytes end too early"};
        values.resize(count);
    }

    void bytes(std::vector<std::byte>& values) {
        const std::uint64_t size = in.takeVarint();
        const auto taken = in.take(size);
        values.assign(taken.begin(), taken.end());
    }

    void text(std::string& value) { value = in.takeText(); }

    void block(scratch::Block& value) { value = scratch::takeBlock(in); }
};

template <class Fields, class Vector>
void vectorFields(Fields& fields, Vector& v) {
    for (int axis = 0; axis < 3; ++axis)
        fields.field(v[axis]);
}

template <class Fields, class SomeBox>
void boxFields(Fields& fields, SomeBox& box) {
    vectorFields(fields, box.min);
    vectorFields(fields, box.max);
}

/// Encodes or decodes a row of the page table in the format of the model file. The row follows the offset of its page
/// in the scratch file.
void pageFields(Putter& fields, const PageInfo& info) {
    fields.field(info.offset);
    hierarchy::putPageRow(fields.out, info);
}

void pageFields(Taker& fields, PageInfo& info) {
    std::uint64_t offset = 0;
    fields.field(offset);
    info = hierarchy::takePageRow(fields.in);
    info.offset = offset;
}

template <class Fields, class Record>
void binnedFields(Fields& fields, Record& record) {
    vectorFields(fields, record.grid.origin);
    fields.field(record.grid.stepExponent);
    fields.field(record.furthest.x);
    fields.field(record.furthest.y);
    fields.field(record.furthest.z);
    boxFields(fields, record.mainPart);
    fields.field(record.medianEdge);
    fields.field(record.strayed.triangles);
    boxFields(fields, record.strayed.corners);
    fields.field(record.format.isDouble);
    fields.field(record.format.hasNormals);
    fields.field(record.format.hasColors);
    for (auto& bits : record.format.fields.bits)
        fields.field(bits);
    fields.field(record.format.isWide);
    fields.count(record.fields);
    for (auto& field : record.fields) {
        fields.text(field.name);
        fields.field(field.min);
        fields.field(field.max);
        fields.field(field.bits);
    }
    fields.field(record.triangles);
    fields.field(record.vertices);
    fields.field(record.notAPolygon);
    fields.field(record.badNormals);
    fields.field(record.chunkCount);
    fields.field(record.largestChunk.triangles);
    fields.field(record.largestChunk.vertices);
    for (auto& count : record.dropped)
        fields.field(count);
    fields.bytes(record.directory);
}

template <class Fields, class Record>
void borderedFields(Fields& fields, Record& record) {
    fields.bytes(record.directory);
}

template <class Fields, class Sums>
void sumFields(Fields& fields, Sums& sums) {
    fields.field(sums.clusters);
    fields.field(sums.triangles);
    fields.field(sums.vertices);
}

template <class Fields, class Record>
void roundFields(Fields& fields, Record& record) {
    fields.field(record.round);
    fields.field(record.isLast);
    fields.count(record.nodes);
    for (auto& node : record.nodes)
        sumFields(fields, node);
    fields.field(record.locks.locked);
    fields.field(record.locks.lockedBefore);
    fields.bytes(record.directory);
}

template <class Fields, class Record>
void nodeFields(Fields& fields, Record& record) {
    fields.field(record.round);
    fields.field(record.node);
    fields.field(record.firstLevel);
    fields.count(record.levels);
    for (auto& level : record.levels) {
        fields.field(level.info.triangles);
        fields.field(level.info.clusters);
        fields.field(level.info.groups);
        fields.field(level.info.maxError);
        fields.field(level.info.maxAttributeError);
        fields.count(level.pages);
        for (auto& page : level.pages)
            pageFields(fields, page);
    }
    fields.block(record.places);
    fields.block(record.clusters);
    sumFields(fields, record.pending);
    fields.field(record.rootTriangles);
    fields.field(record.irreducibleTriangles);
    for (auto& count : record.dropped)
        fields.field(count);
    vectorFields(fields, record.bounds.min);
    vectorFields(fields, record.bounds.max);
    fields.field(record.hasNormals);
}

/// Calls `take(block)` for each block in the encoded StreamStore directory `directory`.
template <class Take>
void forEachBlock(const std::vector<std::byte>& directory, const Take& take) {
    for (const scratch::Blocks& blocks : scratch::StreamStore::blocksOf(directory))
        std::for_each(blocks.begin(), blocks.end(), take);
}

template <class Take>
void forEachBlock(const NodeRecord& node, const Take& take) {
    take(node.places);
    take(node.clusters);
    for (const NodeRecord::LevelOfNode& level : node.levels)
        for (const PageInfo& page : level.pages)
            take({page.offset, page.storedBytes, page.checksum});
}

template <class Record>
std::vector<std::uint32_t> partsOfBlocks(const Record& record) {
    std::vector<std::uint32_t> parts;
    forEachBlock(record, [&](const scratch::Block& block) {
        if (block.bytes > 0) parts.push_back(scratch::partOf(block.offset));
    });
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    return parts;
}

void requireStreams(const std::vector<std::byte>& directory, std::uint64_t count) {
    if (const std::uint64_t found = scratch::StreamStore::blocksOf(directory).size(); found != count)
        throw hierarchy::Damage{"streams: expected " + std::to_string(count) + ", found " + std::to_string(found)};
}

/// Throws Damage if the record of a node has an unknown node number, or if its numbers of clusters and ClusterPlaces
/// differ.
void requireNode(const NodeRecord& node, std::uint64_t nodeCount) {
    if (node.node >= nodeCount) throw hierarchy::Damage{"a record refers to a missing node"};
    if (node.places.bytes % levels::placeBytes(1) != 0 ||
        node.places.bytes / levels::placeBytes(1) != node.pending.clusters)
        throw hierarchy::Damage{"a node has different numbers of places and clusters"};
}

/// Appends the kind of a record as its last byte, and returns the bytes of the record.
std::vector<std::byte> ended(ByteWriter& out, Kind kind) {
    out.put(static_cast<std::uint8_t>(kind));
    return out.take();
}

} // namespace

const std::vector<NodeRecord>& CheckpointLog::nodes(std::uint32_t round) const {
    static const std::vector<NodeRecord> none;
    return round < rounds_.size() ? rounds_[round] : none;
}

void CheckpointLog::beginRound(std::uint32_t round) {
    GNOMON_CHECK_OP(round, <=, rounds_.size());
    if (round < rounds_.size()) return;
    rounds_.emplace_back();
    early_.emplace_back();
    firstPages_.emplace_back();
}

const RoundRecord* CheckpointLog::binnedRound(std::uint32_t round) const {
    return round > 0 && round <= binnedRounds_.size() ? &binnedRounds_[round - 1] : nullptr;
}

void CheckpointLog::add(RoundRecord record) {
    if (record.round != binnedRounds_.size() + 1)
        throw hierarchy::Damage{"a round is not the one after the last round"};
    binnedRounds_.push_back(std::move(record));
}

bool CheckpointLog::isBuilt(std::uint32_t round, std::uint32_t node) const {
    return round < rounds_.size() && (node < rounds_[round].size() || early_[round].contains(node));
}

std::uint64_t CheckpointLog::builtTriangles(std::uint32_t round) const {
    std::uint64_t triangles = 0;
    const auto take = [&](const NodeRecord& node) {
        for (const NodeRecord::LevelOfNode& level : node.levels)
            triangles += level.info.triangles;
    };
    if (round < rounds_.size()) {
        std::for_each(rounds_[round].begin(), rounds_[round].end(), take);
        for (const auto& [number, node] : early_[round])
            take(node);
    }
    return triangles;
}

void CheckpointLog::add(NodeRecord record) {
    if (record.round > rounds_.size()) throw hierarchy::Damage{"a node belongs to a round that has not begun"};
    beginRound(record.round);
    if (isBuilt(record.round, record.node)) throw hierarchy::Damage{"a node is recorded twice"};
    std::map<std::uint32_t, NodeRecord>& early = early_[record.round];
    const std::vector<NodeRecord>& inOrder = rounds_[record.round];
    early.emplace(record.node, std::move(record));
    while (!early.empty() && early.begin()->first == inOrder.size())
        append(std::move(early.extract(early.begin()).mapped()));
}

void CheckpointLog::append(NodeRecord record) {
    for (NodeRecord::LevelOfNode& level : record.levels)
        for (PageInfo& page : level.pages)
            for (std::uint32_t& child : page.children) {
                const levels::PageOfLevel place = levels::placeOfProvisional(child);
                if (place.level >= record.firstLevel && place.level < pageCounts_.size())
                    child = levels::provisionalId(place.level, place.page + pageCounts_[place.level]);
            }
    const std::size_t end = record.firstLevel + record.levels.size();
    if (pageCounts_.size() < end) pageCounts_.resize(end, 0);
    std::vector<std::uint32_t> first(
        pageCounts_.begin() + record.firstLevel, pageCounts_.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t i = 0; i < record.levels.size(); ++i)
        pageCounts_[record.firstLevel + i] += static_cast<std::uint32_t>(record.levels[i].pages.size());
    firstPages_[record.round].push_back(std::move(first));
    rounds_[record.round].push_back(std::move(record));
}

void CheckpointLog::requireConsistent() const {
    const std::uint64_t chunks = binned_ ? binned_->chunkCount : 0;
    if (chunks > chunk::kMaxChunks) throw hierarchy::Damage{"too many chunks"};
    if (!binned_ && (bordered_ || !binnedRounds_.empty() || !rounds_.empty()))
        throw hierarchy::Damage{"records refer to missing chunks"};
    if (binned_) requireStreams(binned_->directory, chunk::binStreams(binned_->chunkCount));
    if (bordered_) requireStreams(bordered_->directory, chunk::borderStreams(binned_->chunkCount));
    for (const RoundRecord& round : binnedRounds_)
        requireStreams(round.directory, kStreamsOfNode * std::uint64_t{round.nodes.size()});
    for (std::uint32_t round = 0; round < roundCount(); ++round) {
        const RoundRecord* const binned = binnedRound(round);
        const std::uint64_t nodeCount = round == 0 ? chunks : binned != nullptr ? binned->nodes.size() : 0;
        for (const NodeRecord& node : rounds_[round]) {
            requireNode(node, nodeCount);
            requireChildren(node);
        }
        for (const auto& [number, node] : early_[round])
            requireNode(node, nodeCount);
    }
}

void CheckpointLog::requireChildren(const NodeRecord& node) const {
    const auto isThere = [&](std::uint32_t child) {
        const levels::PageOfLevel place = levels::placeOfProvisional(child);
        return place.level < pageCounts_.size() && place.page < pageCounts_[place.level];
    };
    for (const NodeRecord::LevelOfNode& level : node.levels)
        for (const PageInfo& page : level.pages)
            if (!std::ranges::all_of(page.children, isThere))
                throw hierarchy::Damage{"a page refers to a missing page"};
}

std::map<std::uint32_t, std::uint64_t> CheckpointLog::scratchBytes() const {
    std::map<std::uint32_t, std::uint64_t> ends;
    std::map<std::uint32_t, std::uint64_t> sums;
    const auto take = [&](const scratch::Block& block) {
        if (block.bytes == 0) return;
        const std::uint32_t part = scratch::partOf(block.offset);
        const std::uint64_t room = scratch::placeOf(part, 0) + scratch::kMaxPartBytes - block.offset;
        if (block.bytes > room) throw hierarchy::Damage{"a block is too long"};
        ends[part] = std::max(ends[part], scratch::kMaxPartBytes - room + block.bytes);
        sums[part] += block.bytes;
        if (sums[part] > scratch::kMaxPartBytes) throw hierarchy::Damage{"blocks overlap"};
    };
    if (binned_) forEachBlock(binned_->directory, take);
    if (bordered_) forEachBlock(bordered_->directory, take);
    for (const RoundRecord& round : binnedRounds_)
        forEachBlock(round.directory, take);
    for (std::size_t round = 0; round < rounds_.size(); ++round) {
        for (const NodeRecord& node : rounds_[round])
            forEachBlock(node, take);
        for (const auto& [number, node] : early_[round])
            forEachBlock(node, take);
    }
    for (const auto& [part, sum] : sums)
        if (sum > ends[part]) throw hierarchy::Damage{"blocks overlap"};
    return ends;
}

std::vector<std::uint32_t> partsOf(const BinnedRecord& record) {
    return partsOfBlocks(record.directory);
}

std::vector<std::uint32_t> partsOf(const BorderedRecord& record) {
    return partsOfBlocks(record.directory);
}

std::vector<std::uint32_t> partsOf(const RoundRecord& record) {
    return partsOfBlocks(record.directory);
}

std::vector<std::uint32_t> partsOf(const NodeRecord& record) {
    return partsOfBlocks(record);
}

void CheckpointLog::addEncoded(std::span<const std::byte> record) {
    if (record.empty()) throw hierarchy::Damage{"a record is empty"};
    ByteReader in(record.first(record.size() - 1));
    Taker fields{in};
    switch (static_cast<Kind>(record.back())) {
    case Kind::Binned: {
        BinnedRecord binned;
        binnedFields(fields, binned);
        add(std::move(binned));
        break;
    }
    case Kind::Bordered: {
        BorderedRecord bordered;
        borderedFields(fields, bordered);
        add(std::move(bordered));
        break;
    }
    case Kind::Round: {
        RoundRecord round;
        roundFields(fields, round);
        add(std::move(round));
        break;
    }
    case Kind::Node:
        return add(decodedNode(record));
    default:
        throw hierarchy::Damage{"a record has an unknown kind"};
    }
    in.expectEnd();
}

NodeRecord decodedNode(std::span<const std::byte> record) {
    if (record.empty() || static_cast<Kind>(record.back()) != Kind::Node)
        throw hierarchy::Damage{"a record is not that of a node"};
    ByteReader in(record.first(record.size() - 1));
    Taker fields{in};
    NodeRecord node;
    nodeFields(fields, node);
    in.expectEnd();
    if (node.firstLevel > hierarchy::kMaxLevels || node.levels.size() > hierarchy::kMaxLevels - node.firstLevel)
        throw hierarchy::Damage{"a node has too many levels"};
    return node;
}

std::vector<std::byte> encoded(const BinnedRecord& record) {
    ByteWriter out;
    Putter fields{out};
    binnedFields(fields, record);
    return ended(out, Kind::Binned);
}

std::vector<std::byte> encoded(const BorderedRecord& record) {
    ByteWriter out;
    Putter fields{out};
    borderedFields(fields, record);
    return ended(out, Kind::Bordered);
}

std::vector<std::byte> encoded(const RoundRecord& record) {
    ByteWriter out;
    Putter fields{out};
    roundFields(fields, record);
    return ended(out, Kind::Round);
}

std::vector<std::byte> encoded(const NodeRecord& record) {
    ByteWriter out;
    Putter fields{out};
    nodeFields(fields, record);
    return ended(out, Kind::Node);
}

} // namespace gnomon::pipeline
