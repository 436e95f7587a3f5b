// The vertices of a page as numbers: what encoder and decoder share.
//
// Vertices come cluster by cluster. One that lies in an earlier cluster of the page too, with the same normal and
// colour, is a reference to it: a quarter to a third of them, along the clusters' borders. Any other is what remains of
// it after prediction: its position from the parallelogram over the edge across which it is new (Touma, Gotsman 1998),
// its normal and colour from the mean of the edge's, else all from the vertex before it; before the first of a cluster
// stands one of no normal, white, whose position is stored apart. Differences are zigzag-coded and stored byte plane by
// byte plane, since the entropy coder that follows works on bytes.
#pragma once

#include <cstdint>

namespace gnomon::hierarchy {

constexpr std::uint32_t kWhite = 0xFFFFFFFFU;
constexpr std::uint32_t kOffsetBinary = 0x80008000U; // turns two snorm16 into numbers that ascend

constexpr std::uint32_t zigzag(std::uint32_t difference) {
    return (difference << 1U) ^ (0U - (difference >> 31U));
}

constexpr std::uint32_t unzigzag(std::uint32_t code) {
    return (code >> 1U) ^ (0U - (code & 1U));
}

/// Normals without the low bits that all of a page lack, as offset binary, so that a mean of two lies between them.
struct NormalCode {
    unsigned shift = 0; // at most 15

    std::uint32_t x(std::uint32_t normal) const { return ((normal ^ kOffsetBinary) & 0xFFFFU) >> shift; }

    std::uint32_t y(std::uint32_t normal) const { return (normal ^ kOffsetBinary) >> (16U + shift); }

    std::uint32_t normal(std::uint32_t x, std::uint32_t y) const {
        return ((x & mask()) << shift | (y & mask()) << (16U + shift)) ^ kOffsetBinary;
    }

    unsigned width() const { return 16U - shift; }

    std::uint32_t mask() const { return (1U << width()) - 1U; }
};

/// What the vertices of a page have.
struct AttributeLayout {
    bool hasNormals = false;
    bool hasColors = false;
    NormalCode normals;
};

} // namespace gnomon::hierarchy
