// The last directed edges that a run of triangles left open: what encoder, decoder and the ordering before them share.
#pragma once

#include <array>
#include <cstdint>

namespace gnomon::hierarchy {

/// An edge as the triangle on its other side would have it, and the corner opposite on this side.
struct OpenEdge {
    std::uint8_t from = 0;
    std::uint8_t to = 0;
    std::uint8_t opposite = 0;
};

/// A ring of the most recent open edges. `recent(0)` is the newest.
class EdgeWindow {
public:
    static constexpr unsigned kSize = 16;

    void push(OpenEdge edge) {
        edges_[head_ & (kSize - 1)] = edge;
        ++head_;
    }

    /// The edges that triangle (a, b, c) offers to its neighbours; one that was entered across (a, b) offers two.
    void pushTriangle(std::uint8_t a, std::uint8_t b, std::uint8_t c, bool entered) {
        if (!entered) push({b, a, c});
        push({a, c, b});
        push({c, b, a});
    }

    unsigned count() const { return head_ < kSize ? head_ : kSize; }

    const OpenEdge& recent(unsigned age) const { return edges_[(head_ - 1 - age) & (kSize - 1)]; }

private:
    std::array<OpenEdge, kSize> edges_{};
    unsigned head_ = 0;
};

} // namespace gnomon::hierarchy
