// The last directed edges that a run of triangles left open: what encoder, decoder and the ordering before them share.
#pragma once

#include <array>
#include <cstdint>

namespace gnomon::hierarchy {

/// An edge as the triangle on its other side would have it, and the corner opposite on this side.
struct OpenEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t opposite = 0;
};

/// A ring of the most recent open edges. `recent(0)` is the newest.
class EdgeWindow {
public:
    static constexpr unsigned kSize = 16;

    /// The edges that triangle (a, b, c) offers to its neighbours; one that was entered across (a, b) offers two.
    void pushTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool entered) {
        if (!entered) push({b, a, c});
        push({a, c, b});
        push({c, b, a});
    }

    unsigned count() const { return head_ < kSize ? head_ : kSize; }

    OpenEdge recent(unsigned age) const {
        const std::uint32_t word = edges_[(head_ - 1 - age) & (kSize - 1)];
        return {word & 0xFFU, word >> 8U & 0xFFU, word >> 16U};
    }

private:
    /// An edge is stored and loaded as one word: bytes stored one by one would stall the load that follows at once.
    void push(const OpenEdge& edge) {
        edges_[head_ & (kSize - 1)] = edge.from | edge.to << 8U | edge.opposite << 16U;
        ++head_;
    }

    std::array<std::uint32_t, kSize> edges_{};
    unsigned head_ = 0;
};

} // namespace gnomon::hierarchy
