// Numbers from 0 for the things of one part of a mesh, in the order of their first use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::levels {

/// Takes one part after another; a new one costs nothing, since each number stored is marked by its part.
class LocalNumbers {
public:
    static constexpr std::uint32_t kMostNumbers = std::numeric_limits<std::uint32_t>::max() / 2;

    /// For things with ids below `count`. Once it has given more than `most` numbers, at most kMostNumbers, it starts
    /// anew with all memory wiped.
    explicit LocalNumbers(std::size_t count, std::uint32_t most = kMostNumbers) : known_(count, 0), most_(most) {}

    /// Forgets all numbers. A part has at most kMostNumbers things.
    void begin() {
        first_ += static_cast<std::uint32_t>(ids_.size());
        ids_.clear();
        if (first_ <= most_) return;
        std::fill(known_.begin(), known_.end(), 0);
        first_ = 1;
    }

    /// The number of `id`.
    std::uint32_t of(std::uint32_t id) {
        std::uint32_t& known = known_[id];
        if (known < first_) {
            known = first_ + static_cast<std::uint32_t>(ids_.size());
            ids_.push_back(id);
        }
        return known - first_;
    }

    /// The things that have a number since `begin`, in its order.
    std::span<const std::uint32_t> ids() const { return ids_; }

private:
    std::vector<std::uint32_t> known_; // per id: `first_` as it was then, and the number
    std::vector<std::uint32_t> ids_;
    std::uint32_t most_;
    std::uint32_t first_ = 1;
};

} // namespace gnomon::levels
