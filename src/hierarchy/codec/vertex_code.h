// The code of the vertices of a page, which the encoder and the decoder share. Vertices are coded cluster by cluster.
// If an earlier cluster of the page contains an equal vertex, the vertex is coded as a reference to it. A quarter to a
// third of all vertices are such references, along the borders of clusters. All other vertices are coded as differences
// from a prediction:
// - If the vertex is new across an edge, the parallelogram over this edge predicts its position (Touma, Gotsman 1998).
//   The mean of the edge's ends predicts its normal and colour.
// - Otherwise the previous vertex predicts all values.
// - The prediction of a cluster's first vertex is a white vertex without normal, whose position is stored separately.
// Differences are zigzag-coded and stored byte plane by byte plane, because the entropy coder that follows works on
// bytes.
#pragma once

#include <cstdint>

namespace gnomon::hierarchy {

constexpr std::uint32_t kWhite = 0xFFFFFFFFU;
constexpr std::uint32_t kOffsetBinary = 0x80008000U; // converts two snorm16 to unsigned numbers in ascending order

constexpr std::uint32_t zigzag(std::uint32_t difference) {
    return (difference << 1U) ^ (0U - (difference >> 31U));
}

constexpr std::uint32_t unzigzag(std::uint32_t code) {
    return (code >> 1U) ^ (0U - (code & 1U));
}

/// The code of the normals of a page: offset binary numbers, without those low bits that are 0 in all normals of the
/// page. With this code, the mean of two codes lies between them.
struct NormalCode {
    unsigned shift = 0; // number of removed low bits, at most 15

    std::uint32_t x(std::uint32_t normal) const { return ((normal ^ kOffsetBinary) & 0xFFFFU) >> shift; }

    std::uint32_t y(std::uint32_t normal) const { return (normal ^ kOffsetBinary) >> (16U + shift); }

    std::uint32_t normal(std::uint32_t x, std::uint32_t y) const {
        return ((x & mask()) << shift | (y & mask()) << (16U + shift)) ^ kOffsetBinary;
    }

    unsigned width() const { return 16U - shift; }

    std::uint32_t mask() const { return (1U << width()) - 1U; }
};

/// Tells which attributes all vertices of a page have besides their position.
struct AttributeLayout {
    bool hasNormals = false;
    bool hasColors = false;
    NormalCode normals;
};

} // namespace gnomon::hierarchy
