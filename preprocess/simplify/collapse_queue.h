// The priority queue of collapses: a tournament tree over the vertices, whose costs may change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::simplify {

/// Each vertex is in the queue at most once; equal costs leave in the order of the vertices. A binary tree stands over
/// all vertices, in the queue or not, whose nodes know the cheapest vertex below them: what changes at one vertex
/// changes nothing beyond the first node that it neither won nor wins.
class CollapseQueue {
public:
    explicit CollapseQueue(std::size_t vertexCount) {
        while (firstLeaf_ < vertexCount)
            firstLeaf_ *= 2;
        cost_.assign(firstLeaf_, kAbsent);
        winner_.resize(firstLeaf_ * 2);
        for (std::uint32_t v = 0; v < firstLeaf_; ++v)
            winner_[firstLeaf_ + v] = v;
        for (std::size_t node = firstLeaf_; node-- > 1;)
            winner_[node] = winner_[node * 2];
    }

    bool isEmpty() const { return leastCost() == kAbsent; }

    bool contains(std::uint32_t vertex) const { return cost_[vertex] != kAbsent; }

    /// The cost of a vertex; infinite if it is not here.
    double costOf(std::uint32_t vertex) const { return cost_[vertex]; }

    /// The cost of the cheapest.
    double leastCost() const { return cost_[winner_[1]]; }

    /// Inserts `vertex` or changes its cost, which is finite.
    void put(std::uint32_t vertex, double cost) {
        cost_[vertex] = cost;
        for (std::size_t node = (firstLeaf_ + vertex) / 2; node > 0; node /= 2) {
            const std::uint32_t before = winner_[node];
            const std::uint32_t now = winnerOf(node);
            winner_[node] = now;
            if (now != vertex && before != vertex) break;
        }
    }

    /// Gives each vertex its cost; infinite ones are not in the queue.
    void putAll(const std::vector<double>& costs) {
        std::copy(costs.begin(), costs.end(), cost_.begin());
        for (std::size_t node = firstLeaf_; node-- > 1;)
            winner_[node] = winnerOf(node);
    }

    void remove(std::uint32_t vertex) {
        if (contains(vertex)) put(vertex, kAbsent);
    }

    /// Removes and returns the cheapest vertex.
    std::uint32_t pop() {
        const std::uint32_t vertex = winner_[1];
        put(vertex, kAbsent);
        return vertex;
    }

private:
    static constexpr double kAbsent = std::numeric_limits<double>::infinity();

    std::uint32_t winnerOf(std::size_t node) const {
        const std::uint32_t left = winner_[node * 2];
        const std::uint32_t right = winner_[node * 2 + 1];
        return cost_[right] < cost_[left] ? right : left;
    }

    std::size_t firstLeaf_ = 1;         // a power of two; node n is over nodes 2n and 2n + 1
    std::vector<double> cost_;          // per vertex
    std::vector<std::uint32_t> winner_; // per node
};

} // namespace gnomon::simplify
