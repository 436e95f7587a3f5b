// A window of the most recent open edges of a sequence of triangles. An edge is open if no second triangle uses it
// yet. The encoder, the decoder and the ordering of triangles share this window.
#pragma once

#include <array>
#include <cstdint>

namespace gnomon::hierarchy {

/// A directed edge as a neighbouring triangle would use it, and the opposite corner of the triangle that left the edge
/// open.
struct OpenEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t opposite = 0;
};

/// A ring buffer of the most recent open edges, in which `recent(0)` is the newest edge.
class EdgeWindow {
public:
    static constexpr unsigned kSize = 16;

    /// Adds the edges of triangle (a, b, c) that are open for later triangles. These are two edges if the triangle
    /// itself continues across the open edge (a, b), and otherwise three.
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
    /// Stores an edge with one write of a whole word. After separate byte writes, the load of the word that follows
    /// immediately would stall.
    void push(const OpenEdge& edge) {
        edges_[head_ & (kSize - 1)] = edge.from | edge.to << 8U | edge.opposite << 16U;
        ++head_;
    }

    std::array<std::uint32_t, kSize> edges_{};
    unsigned head_ = 0;
};

} // namespace gnomon::hierarchy
