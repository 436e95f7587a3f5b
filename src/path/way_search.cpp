#include "path/way_search.h"

#include "core/random.h"

#include <algorithm>
#include <cmath>

namespace gnomon::path {

namespace {

constexpr std::size_t kRegions = 12; // number of searched regions
constexpr int kStarts = 3;           // start positions per region
constexpr int kLegs = 4;             // max legs of a way
constexpr double kAside = 0.8;       // eye heights: distance of a leg from earlier legs
constexpr double kNearObjects = 2;   // in eye heights: max distance of an object beside the way

/// A connected part of the floor.
struct Region {
    double worth = 0;
    std::vector<std::uint32_t> cells;
};

/// The shortest paths from one floor cell to all others: for each cell its predecessor, and the cost, length and
/// interest of the path to it.
struct WayTree {
    std::vector<std::uint32_t> before;
    std::vector<std::uint32_t> cost;
    std::vector<float> length;
    std::vector<float> interest;
};

class WaySearch {
public:
    WaySearch(const WalkableFloor& floor, const WayBounds& bounds) : floor_(floor) {
        const std::size_t count = floor.cells().size();
        tree_.before.resize(count);
        tree_.cost.assign(count, FloorCell::kNone);
        tree_.length.resize(count);
        tree_.interest.resize(count);
        weights_.resize(count);
        for (std::uint32_t i = 0; i < weights_.size(); ++i) {
            const double height = floor.height(floor.cells()[i].floor);
            const bool isAllowed = floor.isWalkable(i) && height >= bounds.low && height <= bounds.high;
            weights_[i] = isAllowed ? static_cast<std::uint8_t>(10 * wayWeight(floor, i)) : std::uint8_t{0};
        }
    }

    std::vector<Region> regions() const;

    /// Returns the most interesting route that starts at the cell `start` and is no longer than `longest`.
    FoundWay bestFrom(std::uint32_t start, double longest);

    /// Removes the floor near `way` from the search for later legs of the walk, except near the end of `way`.
    void close(const std::vector<std::uint32_t>& way);

private:
    void spread(std::uint32_t start);
    void stepFrom(std::uint32_t cell);
    void relax(std::uint32_t from, std::uint32_t to, bool isDiagonal);
    double interestPerLength(std::uint32_t cell) const;

    const WalkableFloor& floor_;
    double longest_ = 0;
    std::vector<std::uint8_t> weights_; // wayWeight of each cell in tenths; 0: not usable for this walk
    WayTree tree_;
    std::vector<std::uint32_t> reached_; // cells in the tree
    // The cells to visit, sorted into buckets by their cost modulo the number of buckets. Each step costs less than
    // this number.
    std::array<std::vector<std::uint32_t>, 256> buckets_;
};

std::vector<Region> WaySearch::regions() const {
    std::vector<Region> regions;
    std::vector<bool> isSeen(weights_.size(), false);
    for (std::uint32_t first = 0; first < weights_.size(); ++first) {
        if (weights_[first] == 0 || isSeen[first]) continue;
        Region region;
        region.cells.push_back(first);
        isSeen[first] = true;
        for (std::size_t i = 0; i < region.cells.size(); ++i) {
            region.worth += floor_.isInside(region.cells[i]) ? 3 : 1;
            for (const std::uint32_t next : floor_.cells()[region.cells[i]].next) {
                if (next == FloorCell::kNone || weights_[next] == 0 || isSeen[next]) continue;
                isSeen[next] = true;
                region.cells.push_back(next);
            }
        }
        regions.push_back(std::move(region));
        std::stable_sort(
            regions.begin(), regions.end(), [](const Region& a, const Region& b) { return a.worth > b.worth; });
        if (regions.size() > kRegions) regions.pop_back();
    }
    return regions;
}

double WaySearch::interestPerLength(std::uint32_t cell) const {
    const double clearance = floor_.clearance(cell) / floor_.body().eyeHeight;
    const double beside = clearance > 0.25 && clearance < kNearObjects ? 1.5 : 1.0;
    return (floor_.isInside(cell) ? 1.0 : 0.25) * beside;
}

void WaySearch::relax(std::uint32_t from, std::uint32_t to, bool isDiagonal) {
    const std::uint32_t cost = tree_.cost[from] + (isDiagonal ? 14U : 10U) * weights_[to] / 10U;
    if (cost >= tree_.cost[to]) return;
    const double cell = floor_.grid().cell;
    const double rise =
        std::abs(floor_.cells()[from].floor - floor_.cells()[to].floor) * floor_.grid().rise / floor_.body().eyeHeight;
    const double run = isDiagonal ? std::sqrt(2.0) * cell : cell;
    const double length = tree_.length[from] + run;
    if (length > longest_) return;
    if (tree_.cost[to] == FloorCell::kNone) reached_.push_back(to);
    tree_.cost[to] = cost;
    tree_.before[to] = from;
    tree_.length[to] = static_cast<float>(length);
    const double perEye = run / floor_.body().eyeHeight;
    tree_.interest[to] = static_cast<float>(tree_.interest[from] + interestPerLength(to) * perEye + 2 * rise);
    buckets_.at(cost % buckets_.size()).push_back(to);
}

void WaySearch::spread(std::uint32_t start) {
    for (const std::uint32_t cell : reached_)
        tree_.cost[cell] = FloorCell::kNone;
    reached_.assign(1, start);
    tree_.cost[start] = 0;
    tree_.before[start] = FloorCell::kNone;
    tree_.length[start] = tree_.interest[start] = 0;
    buckets_[0].assign(1, start);
    std::uint32_t lastUsed = 0;
    for (std::uint32_t cost = 0; cost <= lastUsed + buckets_.size(); ++cost) {
        std::vector<std::uint32_t>& bucket = buckets_.at(cost % buckets_.size());
        // Each step has a positive cost, so the loop adds no cell to the bucket that it reads.
        for (const std::uint32_t cell : bucket) {
            if (tree_.cost[cell] != cost) continue; // a cheaper way was found
            lastUsed = cost;
            stepFrom(cell);
        }
        bucket.clear();
    }
}

void WaySearch::stepFrom(std::uint32_t cell) {
    const auto& next = floor_.cells()[cell].next;
    const auto isOpen = [&](std::uint32_t other) { return other != FloorCell::kNone && weights_[other] != 0; };
    for (std::size_t side = 0; side < next.size(); ++side) {
        if (!isOpen(next.at(side))) continue;
        relax(cell, next.at(side), false);
        const std::size_t turned = (side + 1) % next.size();
        const std::uint32_t corner = floor_.around(cell, side, turned);
        const bool isCorner = isOpen(corner) && corner == floor_.around(cell, turned, side);
        if (isCorner && isOpen(next.at(turned))) relax(cell, corner, true);
    }
}

FoundWay WaySearch::bestFrom(std::uint32_t start, double longest) {
    longest_ = longest;
    spread(start);
    std::uint32_t best = start;
    double maxInterest = -1;
    for (const std::uint32_t i : reached_) {
        // A route that does not end in front of a wall gets a higher score.
        const double room = std::min(1.0, floor_.clearance(i) / floor_.body().eyeHeight);
        if (tree_.interest[i] + 2 * room <= maxInterest) continue;
        maxInterest = tree_.interest[i] + 2 * room;
        best = i;
    }
    const float halfAsInteresting = 0.5F * tree_.interest[best] / std::max(tree_.length[best], 1e-30F);
    const auto worth = [&](std::uint32_t i) { return tree_.interest[i] - halfAsInteresting * tree_.length[i]; };
    for (std::uint32_t cell = best; cell != FloorCell::kNone; cell = tree_.before[cell])
        if (worth(cell) > worth(best)) best = cell; // the part after `cell` has too little interest for its length
    FoundWay way;
    way.length = tree_.length[best];
    way.interest = tree_.interest[best];
    for (std::uint32_t cell = best; cell != FloorCell::kNone; cell = tree_.before[cell])
        way.cells.push_back(cell);
    std::reverse(way.cells.begin(), way.cells.end());
    return way;
}

void WaySearch::close(const std::vector<std::uint32_t>& way) {
    const double aside = kAside * floor_.body().eyeHeight / floor_.grid().cell;
    const auto reach = static_cast<std::int32_t>(aside);
    const auto height = static_cast<std::int32_t>(floor_.body().eyeHeight / floor_.grid().rise);
    const auto placeOf = [&](std::uint32_t cell) { return floor_.placeOf(floor_.cells()[cell].column); };
    const glm::ivec2 end = placeOf(way.back());
    for (const std::uint32_t cell : way)
        for (std::int32_t z = -reach; z <= reach; ++z)
            for (std::int32_t x = -reach; x <= reach; ++x) {
                const glm::ivec2 at = placeOf(cell) + glm::ivec2(x, z);
                if (x * x + z * z > aside * aside || glm::distance(glm::dvec2(at), glm::dvec2(end)) <= aside) continue;
                const std::uint32_t beside = floor_.nearest(at.x, at.y, floor_.cells()[cell].floor, height);
                if (beside != FloorCell::kNone) weights_[beside] = 0;
            }
}

} // namespace

double wayWeight(const WalkableFloor& floor, std::uint32_t cell) {
    const double comfort = 0.5 * floor.body().eyeHeight;
    const double clearance = floor.clearance(cell);
    const double tightness = 1 + 4 * std::max(0.0, 1 - clearance / comfort);
    return tightness * (floor.isInside(cell) ? 1 : 2) * (clearance < kNearObjects * floor.body().eyeHeight ? 1 : 1.3);
}

std::optional<FoundWay> findWay(const WalkableFloor& floor, const WayBounds& bounds) {
    WaySearch search(floor, bounds);
    Random random(1);
    std::optional<FoundWay> best;
    for (const Region& region : search.regions())
        for (int i = 0; i < kStarts; ++i) {
            const std::uint32_t start = region.cells[random.below(region.cells.size())];
            const FoundWay there = search.bestFrom(start, bounds.longest);
            FoundWay back = search.bestFrom(there.cells.back(), bounds.longest);
            if (!best || back.interest > best->interest) best = std::move(back);
        }
    for (int leg = 1; best && leg < kLegs; ++leg) {
        search.close(best->cells);
        const FoundWay next = search.bestFrom(best->cells.back(), bounds.longest - best->length);
        const bool isAsInteresting = next.interest * best->length > 0.5 * best->interest * next.length;
        if (next.length < floor.body().eyeHeight || !isAsInteresting) break;
        best->cells.insert(best->cells.end(), next.cells.begin() + 1, next.cells.end());
        best->length += next.length;
        best->interest += next.interest;
    }
    return best;
}

} // namespace gnomon::path
