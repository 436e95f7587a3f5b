// The priority queue of edge collapses. It is a tournament tree over the vertices, in which costs can change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::simplify {

/// A priority queue of vertices, with the cheapest vertex first. Each vertex is in the queue at most once. Vertices
/// with equal costs are in the order of their index. Each node of a binary tree over all vertices stores the cheapest
/// vertex below it (the winner). If the cost of a vertex changes, the update goes up the tree. It stops at the first
/// node whose winner neither was nor is this vertex.
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

    bool isEmpty() const { return minCost() == kAbsent; }

    bool contains(std::uint32_t vertex) const { return cost_[vertex] != kAbsent; }

    /// Returns the cost of a vertex, or infinity if the vertex is not in the queue.
    double costOf(std::uint32_t vertex) const { return cost_[vertex]; }

    /// Returns the lowest cost of all vertices in the queue.
    double minCost() const { return cost_[winner_[1]]; }

    /// Inserts `vertex` into the queue or changes its cost. The cost must be finite.
    void put(std::uint32_t vertex, double cost) {
        cost_[vertex] = cost;
        for (std::size_t node = (firstLeaf_ + vertex) / 2; node > 0; node /= 2) {
            const std::uint32_t before = winner_[node];
            const std::uint32_t now = winnerOf(node);
            winner_[node] = now;
            if (now != vertex && before != vertex) break;
        }
    }

    /// Replaces the costs of all vertices. A vertex with infinite cost is not in the queue.
    void putAll(const std::vector<double>& costs) {
        std::copy(costs.begin(), costs.end(), cost_.begin());
        for (std::size_t node = firstLeaf_; node-- > 1;)
            winner_[node] = winnerOf(node);
    }

    void remove(std::uint32_t vertex) {
        if (contains(vertex)) put(vertex, kAbsent);
    }

    /// Removes the cheapest vertex from the queue and returns it.
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

    std::size_t firstLeaf_ = 1;         // a power of two; the children of node n are 2n and 2n + 1
    std::vector<double> cost_;          // cost of each vertex
    std::vector<std::uint32_t> winner_; // for each tree node, the cheapest vertex below it
};

} // namespace gnomon::simplify
