// What the vertices of a page carry besides normal and colour: some numbers each, that share a word.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::hierarchy {

/// The most fields of a model: their numbers share a word of 32 bits.
constexpr std::size_t kMostFields = 4;

/// How the fields of a vertex share a word: the first in the lowest bits.
struct FieldLayout {
    std::array<std::uint8_t, kMostFields> bits{}; // of each, 0 behind the last; 32 together at most

    /// That of `count` fields, at most kMostFields, as builds lay them out: 16 bits each, or as many as there is room
    /// for.
    static constexpr FieldLayout of(std::size_t count) {
        FieldLayout layout;
        for (std::size_t field = 0; field < count; ++field)
            layout.bits[field] = static_cast<std::uint8_t>(count > 2 ? 32 / count : 16);
        return layout;
    }

    constexpr std::size_t count() const {
        std::size_t count = 0;
        while (count < kMostFields && bits[count] > 0)
            ++count;
        return count;
    }

    constexpr unsigned shift(std::size_t field) const {
        unsigned shift = 0;
        for (std::size_t before = 0; before < field; ++before)
            shift += bits[before];
        return shift;
    }

    /// The greatest number of a field.
    constexpr std::uint32_t greatest(std::size_t field) const { return (1U << bits[field]) - 1U; }

    /// The number of a field, which must be there.
    constexpr std::uint32_t number(std::uint32_t word, std::size_t field) const {
        return word >> shift(field) & greatest(field);
    }

    bool operator==(const FieldLayout&) const = default;
};

/// The fields of all vertices of a page.
struct PageFields {
    FieldLayout layout;
    std::vector<std::uint32_t> words; // by vertex; empty without fields

    bool operator==(const PageFields&) const = default;
};

} // namespace gnomon::hierarchy
