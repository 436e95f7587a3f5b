// The fields of a page's vertices. A field is a scalar property besides normal and colour. All fields of a vertex are
// packed into one 32-bit word.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::hierarchy {

/// The max number of fields of a model, which share the 32 bits of one word per vertex.
constexpr std::size_t kMaxFields = 4;

/// The number of bits that each field has in the word of a vertex. The first field has the lowest bits.
struct FieldLayout {
    std::array<std::uint8_t, kMaxFields> bits{}; // per field; 0 after the last field; at most 32 in total

    /// Returns how `count` fields (at most kMaxFields) share the 32-bit word of a vertex. Each field has 16 bits, or an
    /// equal share of the 32 bits if there are more than two fields.
    static constexpr FieldLayout of(std::size_t count) {
        FieldLayout layout;
        for (std::size_t field = 0; field < count; ++field)
            layout.bits[field] = static_cast<std::uint8_t>(count > 2 ? 32 / count : 16);
        return layout;
    }

    constexpr std::size_t count() const {
        std::size_t count = 0;
        while (count < kMaxFields && bits[count] > 0)
            ++count;
        return count;
    }

    constexpr unsigned shift(std::size_t field) const {
        unsigned shift = 0;
        for (std::size_t before = 0; before < field; ++before)
            shift += bits[before];
        return shift;
    }

    /// Returns the largest integer that the given field can store.
    constexpr std::uint32_t maxNumber(std::size_t field) const { return (1U << bits[field]) - 1U; }

    /// Returns the integer value of a field from the word of a vertex. The field must exist.
    constexpr std::uint32_t number(std::uint32_t word, std::size_t field) const {
        return word >> shift(field) & maxNumber(field);
    }

    bool operator==(const FieldLayout&) const = default;
};

/// The field values of all vertices of a page, one word per vertex.
struct PageFields {
    FieldLayout layout;
    std::vector<std::uint32_t> words; // one word per vertex; empty if there are no fields

    bool operator==(const PageFields&) const = default;
};

} // namespace gnomon::hierarchy
