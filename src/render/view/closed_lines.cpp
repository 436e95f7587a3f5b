#include "render/view/closed_lines.h"

#include "core/index_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gnomon::render {

namespace {

constexpr double kWeld = 2;   // max distance in cells between end points that are merged
constexpr double kBridge = 8; // max distance in cells between end points that an additional line can connect

/// A union-find data structure for the elements 0 to `count` - 1.
class Joined {
public:
    explicit Joined(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

    std::uint32_t find(std::uint32_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }

    void join(std::uint32_t a, std::uint32_t b) { parents_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parents_;
};

std::uint64_t hashOfThree(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return mix64(a * 0x9E3779B97F4A7C15U + b * 0xC2B2AE3D27D4EB4FU + c * 0x165667B19E3779F9U);
}

std::uint64_t hashOfPoint(const glm::dvec3& p) {
    const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v + 0.0); }; // + 0.0 makes -0 and 0 equal
    return hashOfThree(bits(p.x), bits(p.y), bits(p.z));
}

/// The distinct positions ("places") of the end points of all lines. Each line has two entries in `ofEnds`, its start
/// first.
struct Places {
    std::vector<std::uint32_t> ofEnds;
    std::vector<glm::dvec3> points; // position per place
};

/// Finds the distinct positions (places) of all end points. Bit-identical positions are one place.
Places samePlaces(const std::vector<SectionLine>& lines) {
    Places places;
    places.ofEnds.reserve(2 * lines.size());
    places.points.reserve(lines.size() + 1);
    IndexTable table(2 * lines.size());
    const auto add = [&](const glm::dvec3& p) {
        const auto next = static_cast<std::uint32_t>(places.points.size());
        places.ofEnds.push_back(
            table.findOrInsert(hashOfPoint(p), next, [&](std::uint32_t other) { return places.points[other] == p; }));
        if (places.ofEnds.back() == next) places.points.push_back(p);
    };
    for (const SectionLine& line : lines) {
        add(line.from);
        add(line.to);
    }
    return places;
}

using PointKey = std::array<std::int64_t, 3>;

template <class Use>
void forAllKeys(const PointKey& low, const PointKey& high, const Use& use) {
    for (PointKey key = low; key[0] <= high[0]; ++key[0])
        for (key[1] = low[1]; key[1] <= high[1]; ++key[1])
            for (key[2] = low[2]; key[2] <= high[2]; ++key[2])
                use(key);
}

/// Calls `use` for each pair of `points` whose distance is at most `reach`. The first argument is the later point of
/// the pair.
template <class Use>
void forAllPairs(const std::vector<glm::dvec3>& points, double reach, const Use& use) {
    const double perCell = 1 / (16 * reach); // cells are large, so that few points are near a border of a cell
    const auto keyOf = [&](const glm::dvec3& p) {
        constexpr double kCellOffset = 0x1p40; // makes all coordinates positive, so that truncation rounds down
        return PointKey{
            static_cast<std::int64_t>(p.x * perCell + kCellOffset),
            static_cast<std::int64_t>(p.y * perCell + kCellOffset),
            static_cast<std::int64_t>(p.z * perCell + kCellOffset)};
    };
    const auto hashOfKey = [](const PointKey& key) {
        const auto bits = [&](std::size_t axis) { return static_cast<std::uint64_t>(key.at(axis)); };
        return hashOfThree(bits(0), bits(1), bits(2));
    };
    constexpr std::uint32_t kLast = IndexTable::kAbsent;
    IndexTable firsts(points.size());               // first point per cell
    std::vector<std::uint32_t> next(points.size()); // next point in the same cell
    std::vector<PointKey> keys(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        // The range of hash grid cells that can contain a point within `reach`. Usually it is one cell.
        const PointKey low = keyOf(points[i] - reach);
        const PointKey high = keyOf(points[i] + reach);
        keys[i] = low == high ? low : keyOf(points[i]);
        forAllKeys(low, high, [&](const PointKey& near) {
            const auto isThere = [&](std::uint32_t other) { return keys[other] == near; };
            for (std::uint32_t k = firsts.find(hashOfKey(near), isThere); k != kLast; k = next[k])
                if (glm::length(points[i] - points[k]) <= reach) use(i, k);
        });
        const std::uint32_t first =
            firsts.findOrInsert(hashOfKey(keys[i]), i, [&](std::uint32_t other) { return keys[other] == keys[i]; });
        next[i] = kLast;
        if (first != i) next[i] = std::exchange(next[first], i);
    }
}

/// Returns the surplus of each end point position: the number of outgoing minus incoming lines.
std::vector<int> surplusOf(const std::vector<std::uint32_t>& ends, std::size_t placeCount) {
    std::vector<int> surplus(placeCount);
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        ++surplus[ends[i]];
        --surplus[ends[i + 1]];
    }
    return surplus;
}

/// Marks lines as closed. The function marks a connected component if each end point has as many outgoing as incoming
/// lines.
void markBalanced(const Places& places, std::vector<SectionLine>& lines) {
    const std::vector<int> surplus = surplusOf(places.ofEnds, places.points.size());
    Joined joined(places.points.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
        joined.join(places.ofEnds[2 * i], places.ofEnds[2 * i + 1]);
    std::vector<bool> isOpen(places.points.size());
    for (std::uint32_t i = 0; i < surplus.size(); ++i)
        if (surplus[i] != 0) isOpen[joined.find(i)] = true;
    for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i].isClosed = !isOpen[joined.find(places.ofEnds[2 * i])];
}

/// The lines that are not marked as closed: their indices, and the positions of their end points.
struct OpenLines {
    std::vector<std::uint32_t> numbers;
    Places places;
};

OpenLines openLines(const std::vector<SectionLine>& lines, const Places& places) {
    OpenLines open;
    std::vector<std::uint32_t> newPlaces(places.points.size(), IndexTable::kAbsent);
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        if (lines[i].isClosed) continue;
        open.numbers.push_back(i);
        for (const std::uint32_t end : {2 * i, 2 * i + 1}) {
            std::uint32_t& place = newPlaces[places.ofEnds[end]];
            if (place == IndexTable::kAbsent) {
                place = static_cast<std::uint32_t>(open.places.points.size());
                open.places.points.push_back(places.points[places.ofEnds[end]]);
            }
            open.places.ofEnds.push_back(place);
        }
    }
    return open;
}

/// A directed graph whose nodes are end point positions and whose edges are lines. Lines before `onceCount` can be
/// removed once. Lines from `onceCount` on can be removed any number of times.
struct LineGraph {
    std::vector<std::uint32_t> ends;   // two places per line
    std::vector<std::int64_t> lengths; // per line
    std::vector<int> surplus;          // per place: outgoing minus incoming lines
    std::size_t onceCount = 0;         // number of lines that can be removed at most once
};

/// Removes lines of min total length from a graph, so that each node has as many outgoing as incoming lines.
class MinOpening {
public:
    explicit MinOpening(LineGraph graph)
        : ends_(std::move(graph.ends)),
          lengths_(std::move(graph.lengths)),
          surplus_(std::move(graph.surplus)),
          onceCount_(graph.onceCount),
          dropped_(lengths_.size()),
          firstAt_(surplus_.size() + 1),
          potentials_(surplus_.size()),
          reached_(surplus_.size()) {
        for (const std::uint32_t place : ends_)
            ++firstAt_[place + 1];
        std::partial_sum(firstAt_.begin(), firstAt_.end(), firstAt_.begin());
        linesAt_.resize(ends_.size());
        std::vector<std::uint32_t> to(firstAt_.begin(), firstAt_.end() - 1);
        for (std::uint32_t i = 0; i < ends_.size(); ++i)
            linesAt_[to[ends_[i]]++] = i;
    }

    void run() {
        for (std::uint32_t place = 0; place < surplus_.size(); ++place)
            while (surplus_[place] > 0)
                dropFrom(place);
    }

    /// Returns the number of times that the algorithm removed `line` from the graph.
    int dropped(std::size_t line) const { return dropped_[line]; }

private:
    static constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();
    static constexpr std::uint32_t kNoEnd = 0xFFFFFFFFU;

    struct Reached {
        std::int64_t length = kFar;
        std::uint32_t byEnd = kNoEnd; // end of the path's last line, at the previous place of the path
    };

    struct Waiting {
        std::int64_t length;
        std::uint32_t place;

        bool operator<(const Waiting& other) const { // reversed, because the heap has its max element at the top
            return length != other.length ? length > other.length : place > other.place;
        }
    };

    /// Relaxes the lines at the node `from`, whose distance is known (Dijkstra). The search follows existing lines
    /// forward. It follows removed lines backward, which restores them.
    void spread(const Waiting& from) {
        for (std::uint32_t k = firstAt_[from.place]; k < firstAt_[from.place + 1]; ++k) {
            const std::uint32_t end = linesAt_[k];
            const std::size_t line = end / 2;
            const bool isForward = end % 2 == 0;
            const bool canGo = isForward ? dropped_[line] == 0 || line >= onceCount_ : dropped_[line] > 0;
            if (!canGo) continue;
            const std::uint32_t place = ends_[end ^ 1U];
            const std::int64_t length = from.length + (isForward ? lengths_[line] : -lengths_[line]) +
                                        potentials_[from.place] - potentials_[place];
            if (length >= reached_[place].length) continue;
            if (reached_[place].byEnd == kNoEnd) touched_.push_back(place);
            reached_[place] = {length, end};
            waiting_.push_back({length, place});
            std::push_heap(waiting_.begin(), waiting_.end());
        }
    }

    /// Removes the lines of the shortest path from `start` to a node with more incoming than outgoing lines.
    void dropFrom(std::uint32_t start) {
        touched_.assign(1, start);
        waiting_.assign(1, {0, start});
        reached_[start] = {0, kNoEnd};
        // A node with more outgoing than incoming lines has a path to a node with more incoming lines, because each
        // node on the way has an existing outgoing line.
        Waiting nearest = waiting_.front();
        while (true) {
            std::pop_heap(waiting_.begin(), waiting_.end());
            nearest = waiting_.back();
            waiting_.pop_back();
            if (nearest.length > reached_[nearest.place].length) continue;
            if (surplus_[nearest.place] < 0) break;
            spread(nearest);
        }
        for (std::uint32_t at = nearest.place; at != start;) {
            const std::uint32_t end = reached_[at].byEnd;
            dropped_[end / 2] += end % 2 == 0 ? 1 : -1;
            at = ends_[end];
        }
        --surplus_[start];
        ++surplus_[nearest.place];
        for (const std::uint32_t place : touched_) { // updates the potentials so that reduced lengths stay non-negative
            potentials_[place] += std::min<std::int64_t>(reached_[place].length - nearest.length, 0);
            reached_[place] = {};
        }
    }

    std::vector<std::uint32_t> ends_;
    std::vector<std::int64_t> lengths_;
    std::vector<int> surplus_;
    std::size_t onceCount_;
    std::vector<int> dropped_;
    std::vector<std::uint32_t> firstAt_; // per place: index of its first entry in linesAt_
    std::vector<std::uint32_t> linesAt_; // the ends of lines at each place
    std::vector<std::int64_t> potentials_;
    std::vector<Reached> reached_;
    std::vector<Waiting> waiting_;
    std::vector<std::uint32_t> touched_;
};

std::int64_t lengthOf(const glm::dvec3& a, const glm::dvec3& b) {
    return 1 + std::llround(glm::length(b - a));
}

/// Adds possible lines ("bridges") to `graph`, between nearby nodes with surplus of opposite sign. If the algorithm
/// removes a bridge from the graph, a line between its ends is added to the section.
void addBridges(const std::vector<glm::dvec3>& points, LineGraph& graph) {
    std::vector<std::uint32_t> places;
    std::vector<glm::dvec3> positions;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (graph.surplus[i] == 0) continue;
        places.push_back(i);
        positions.push_back(points[i]);
    }
    forAllPairs(positions, kBridge, [&](std::uint32_t a, std::uint32_t b) {
        if (graph.surplus[places[a]] < 0) std::swap(a, b);
        if (graph.surplus[places[a]] < 0 || graph.surplus[places[b]] > 0) return;
        graph.ends.insert(graph.ends.end(), {places[a], places[b]});
        graph.lengths.push_back(lengthOf(positions[a], positions[b]));
    });
}

} // namespace

void markClosed(std::vector<SectionLine>& lines) {
    const Places all = samePlaces(lines);
    markBalanced(all, lines);
    const auto [numbers, places] = openLines(lines, all);
    Joined joined(places.points.size());
    forAllPairs(places.points, kWeld, [&](std::uint32_t a, std::uint32_t b) { joined.join(a, b); });
    LineGraph graph{places.ofEnds, {}, {}, numbers.size()};
    for (std::uint32_t& end : graph.ends)
        end = joined.find(end);
    graph.surplus = surplusOf(graph.ends, places.points.size());
    for (const std::uint32_t i : numbers)
        graph.lengths.push_back(lengthOf(lines[i].from, lines[i].to));
    addBridges(places.points, graph);
    const std::vector<std::uint32_t> ends = graph.ends;
    MinOpening opening(std::move(graph));
    opening.run();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (opening.dropped(i) != 0) continue;
        // Merged end points receive identical positions. A gap between them would make the winding numbers of a pixel
        // row wrong.
        lines[numbers[i]] = {places.points[ends[2 * i]], places.points[ends[2 * i + 1]], true};
    }
    for (std::size_t i = numbers.size(); i < ends.size() / 2; ++i)
        for (int k = 0; k < opening.dropped(i); ++k)
            lines.push_back({places.points[ends[2 * i + 1]], places.points[ends[2 * i]], true});
}

} // namespace gnomon::render
