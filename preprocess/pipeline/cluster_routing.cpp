#include "preprocess/pipeline/cluster_routing.h"

#include "core/check.h"
#include "core/index_table.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

using hierarchy::GridPoint;
using hierarchy::kNone;

std::uint64_t hashOf(const GridPoint& p) {
    return gnomon::hashOf(p.x, p.y, p.z);
}

template <class T>
void put(StreamBytes& streams, std::uint32_t stream, const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    std::vector<std::byte>& all = streams[stream];
    all.insert(all.end(), bytes.begin(), bytes.end());
}

/// The positions of a finished node's clusters, and the nodes of the next round that use each position.
class PositionUses {
public:
    explicit PositionUses(std::size_t maxPositions) : table_(maxPositions) {}

    void addBorder(const GridPoint& position) { positions_[find(position)].isBorder = true; }

    void add(const GridPoint& position, std::uint32_t node) {
        const std::uint32_t found = find(position);
        std::uint32_t& first = positions_[found].firstNode;
        if (first == kNone) first = node;
        if (first != node) others_.push_back({found, node});
    }

    /// Calls `take(position, whether it was a border, nodes that use it)` for each position. Positions are in the order
    /// of insertion.
    template <class Take>
    void forEach(const Take& take) {
        std::sort(others_.begin(), others_.end());
        others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
        auto other = others_.begin();
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t p = 0; p < positions_.size(); ++p) {
            nodes.assign(1, positions_[p].firstNode);
            for (; other != others_.end() && other->position == p; ++other)
                nodes.push_back(other->node);
            take(positions_[p].position, positions_[p].isBorder, std::span<const std::uint32_t>(nodes));
        }
    }

private:
    struct Used {
        GridPoint position;
        std::uint32_t firstNode = kNone;
        bool isBorder = false;
    };

    struct OtherUse {
        std::uint32_t position = 0;
        std::uint32_t node = 0;
        auto operator<=>(const OtherUse&) const = default;
    };

    std::uint32_t find(const GridPoint& position) {
        const auto next = static_cast<std::uint32_t>(positions_.size());
        const std::uint32_t found = table_.findOrInsert(
            hashOf(position), next, [&](std::uint32_t other) { return positions_[other].position == position; });
        if (found == next) positions_.push_back({position});
        return found;
    }

    IndexTable table_;
    std::vector<Used> positions_;
    std::vector<OtherUse> others_; // all uses of a position after its first use
};

} // namespace

RoutedClusters routed(const LeftClusters& left, std::uint32_t borderStreams) {
    RoutedClusters result;
    const std::vector<levels::ClusterPlace> places =
        levels::clusterPlaces(left.bytes.first(levels::placeBytes(left.nodeOf.size())));
    std::size_t end = levels::placeBytes(places.size());
    std::size_t vertices = 0;
    std::map<std::uint32_t, std::size_t> bytesOf;
    for (std::size_t c = 0; c < places.size(); ++c) {
        end += places[c].bytes;
        vertices += places[c].vertices;
        bytesOf[left.nodeOf[c]] += places[c].bytes;
    }
    for (const auto& [node, bytes] : bytesOf)
        result.records[node].reserve(bytes);
    const std::vector<GridPoint> borders = levels::positionsFrom(left.bytes.subspan(end));
    PositionUses uses(vertices);
    for (const GridPoint& border : borders)
        uses.addBorder(border);
    std::size_t begin = levels::placeBytes(places.size());
    for (std::size_t c = 0; c < places.size(); ++c) {
        const std::span<const std::byte> record = left.bytes.subspan(begin, places[c].bytes);
        begin += places[c].bytes;
        for (const GridPoint& position : levels::positionsOfRecord(record))
            uses.add(position, left.nodeOf[c]);
        std::vector<std::byte>& out = result.records[left.nodeOf[c]];
        out.insert(out.end(), record.begin(), record.end());
        levels::countPagesFrom(std::span(out).last(record.size()), left.firstLevel, left.firstPages);
    }
    uses.forEach([&](const GridPoint& position, bool isBorder, std::span<const std::uint32_t> nodes) {
        if (!isBorder && nodes.size() > 1) ++result.counts.locked;
        for (const std::uint32_t node : nodes)
            if (isBorder)
                put(result.borders,
                    static_cast<std::uint32_t>(hashOf(position) % borderStreams),
                    BorderUse{position, node});
            else if (nodes.size() > 1)
                put(result.locks, node, position);
    });
    return result;
}

StreamBytes sharedBorders(std::vector<BorderUse> uses, LockCounts& counts) {
    StreamBytes locks;
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    for (auto first = uses.begin(); first != uses.end();) {
        const auto last =
            std::find_if(first, uses.end(), [&](const BorderUse& use) { return use.position != first->position; });
        if (last - first > 1) {
            ++counts.locked;
            ++counts.lockedBefore;
            for (auto use = first; use != last; ++use)
                put(locks, use->node, use->position);
        }
        first = last;
    }
    return locks;
}

} // namespace gnomon::pipeline
