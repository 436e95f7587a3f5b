// A table that numbers the elements of one part of a mesh from 0, in the order of first use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::levels {

/// Local numbers of one part after another. A new part costs no clearing, because stored numbers of earlier parts are
/// recognisable by their smaller values.
class LocalNumbers {
public:
    static constexpr std::uint32_t kMaxNumbers = std::numeric_limits<std::uint32_t>::max() / 2;

    /// Creates a table for ids below `count`. After more than `maxNumbers` numbers (at most kMaxNumbers) the table
    /// clears its memory.
    explicit LocalNumbers(std::size_t count, std::uint32_t maxNumbers = kMaxNumbers)
        : known_(count, 0), maxNumbers_(maxNumbers) {}

    /// Starts a new part. A part has at most kMaxNumbers elements.
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
    std::vector<std::uint32_t> known_; // per id: `first_` at the time plus the local number
    std::vector<std::uint32_t> ids_;
    std::uint32_t maxNumbers_;
    std::uint32_t first_ = 1;
};

} // namespace gnomon::levels
