// A table that numbers the elements of one part of a mesh. Numbers start at 0, in the order of first use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::levels {

/// Local numbers for one part of a mesh after another. A new part does not clear the table: the stored numbers of
/// earlier parts have smaller values and are therefore recognisable.
class LocalNumbers {
public:
    static constexpr std::uint32_t kMaxNumbers = std::numeric_limits<std::uint32_t>::max() / 2;

    /// Creates a table for ids below `count`. The table is cleared only after more than `maxNumbers` numbers in total
    /// (at most kMaxNumbers).
    explicit LocalNumbers(std::size_t count, std::uint32_t maxNumbers = kMaxNumbers)
        : known_(count, 0), maxNumbers_(maxNumbers) {}

    /// Starts a new part and forgets the numbers of the previous one. A part has at most kMaxNumbers elements.
    void begin() {
        first_ += static_cast<std::uint32_t>(ids_.size());
        ids_.clear();
        if (first_ <= maxNumbers_) return;
        std::fill(known_.begin(), known_.end(), 0);
        first_ = 1;
    }

    /// Returns the local number of `id`. A new id gets the next number.
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
    // per id: its local number plus the value of `first_` when the number was assigned
    std::vector<std::uint32_t> known_;
    std::vector<std::uint32_t> ids_;
    std::uint32_t maxNumbers_;
    std::uint32_t first_ = 1;
};

} // namespace gnomon::levels
