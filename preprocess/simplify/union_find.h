// A union-find structure over the ids 0 to count - 1. The smallest id represents its set, so that the result does not
// depend on the order of unions.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace gnomon::simplify {

/// Disjoint sets of ids (union-find) with path halving.
class UnionFind {
public:
    explicit UnionFind(std::uint32_t count) : parent_(count), count_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    std::uint32_t root(std::uint32_t id) {
        while (parent_[id] != id) {
            parent_[id] = parent_[parent_[id]];
            id = parent_[id];
        }
        return id;
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return;
        if (a > b) std::swap(a, b);
        parent_[b] = a;
        --count_;
    }

    /// Returns the current number of disjoint sets.
    std::uint32_t count() const { return count_; }

private:
    std::vector<std::uint32_t> parent_;
    std::uint32_t count_;
};

} // namespace gnomon::simplify
