// A hash table from keys to 32-bit indices. The caller stores the keys. The results depend only on the order of the
// calls.
#pragma once

#include "core/random.h"

#include <vector>

namespace gnomon {

/// A hash table with open addressing and linear probing that stores only indices. The callers pass the hash of a key,
/// and a function `equal(i)` that returns true if index i belongs to this key.
class IndexTable {
public:
    static constexpr std::uint32_t kAbsent = 0xFFFFFFFFU;

    /// Makes an empty table with memory for `count` keys.
    explicit IndexTable(std::size_t count) {
        std::size_t size = 16;
        while (size < count * 2)
            size *= 2;
        slots_.assign(size, kAbsent);
    }

    /// Returns the stored index for which `equal` is true. If there is none, stores `index` and returns it.
    template <class Equal>
    std::uint32_t findOrInsert(std::uint64_t hash, std::uint32_t index, Equal equal) {
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t i = hash & mask;; i = (i + 1) & mask) {
            if (slots_[i] == kAbsent) return slots_[i] = index;
            if (equal(slots_[i])) return slots_[i];
        }
    }

    /// Returns the stored index for which `equal` is true, or kAbsent if there is none.
    template <class Equal>
    std::uint32_t find(std::uint64_t hash, Equal equal) const {
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t i = hash & mask;; i = (i + 1) & mask)
            if (slots_[i] == kAbsent || equal(slots_[i])) return slots_[i];
    }

    /// Prefetches the cache line of the first slot for `hash`.
    void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]); }

private:
    std::vector<std::uint32_t> slots_;
};

inline std::uint64_t hashOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return mix64(mix64(static_cast<std::uint64_t>(a) << 32U | b) + c);
}

} // namespace gnomon
