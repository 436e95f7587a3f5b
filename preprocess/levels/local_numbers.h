// A table that assigns consecutive numbers to the ids of one part of a mesh. Numbers start at 0, in the order of first
// use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::levels {

/// Assigns local numbers to the ids of one part of a mesh after another. A new part does not clear the table. Numbers
/// of earlier parts are recognisable because their stored values are smaller.
class LocalNumbers {
public:
    static constexpr std::uint32_t kMaxNumbers = std::numeric_limits<std::uint32_t>::max() / 2;

    /// Creates a table for ids below `count`. The table is cleared only after more than `maxNumbers` numbers in total
    /// (at most kMaxNumbers).
    explicit LocalNumbers(std::size_t count, std::uint32_t maxNumbers = kMaxNumbers)
        : known_(count, 0), maxNumbers_(maxNumbers) {}

    /// Starts a new part of the mesh, and forgets the numbers of the previous part. A part has at most kMaxNumbers
    /// elements.
    void begin() {
        first_ += static_cast<std::uint32_t>(ids_.size());
        ids_.clear();
        if (first_ <= maxNumbers_) return;
        std::fill(known_.begin(), known_.end(), 0);
        first_ = 1;
    }

    /// Returns the local number of `id`. A new id receives the next unused number.
    std::uint32_t of(std::uint32_t id) {
        std::uint32_t& known = known_[id];
        if (known < first_) {
            known = first_ + static_cast<std::uint32_t>(ids_.size());
            ids_.push_back(id);
        }
        return known - first_;
    }

    /// Returns the ids of the current part in the order of their numbers.
    std::span<const std::uint32_t> ids() const { return ids_; }

private:
    // for each id, its local number plus the value of `first_` at the time of the assignment
    std::vector<std::uint32_t> known_;
    std::vector<std::uint32_t> ids_;
    std::uint32_t maxNumbers_;
    std::uint32_t first_ = 1;
};

} // namespace gnomon::levels
