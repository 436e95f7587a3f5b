// The triangles of a cluster as codes.
//
// One code byte a triangle. High nibble: the age of the open edge across which the triangle is entered (then its first
// two corners are that edge), or 15 for none. Low nibble, entered: 0 if the third corner is the next new vertex, 1-14
// if it is the vertex that many before the next new one, 15 if its index follows in the second stream. Not entered: bit
// k says that corner k is the next new vertex, else its index follows.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/edge_window.h"
#include "hierarchy/page.h"

#include <algorithm>
#include <array>
#include <span>

namespace gnomon::hierarchy {

constexpr unsigned kNotEntered = 15; // as the age of an edge
constexpr unsigned kExplicit = 15;   // as the distance of a third corner

/// What a vertex is predicted from if it was new across an edge; else the vertex before it.
struct Parents {
    std::uint8_t from = 0;
    std::uint8_t to = 0;
    std::uint8_t opposite = 0;
    std::uint8_t acrossEdge = 0; // 0 or 1

    Parents() = default;

    /// Of vertex `v`, which can follow from earlier ones only.
    Parents(const OpenEdge& edge, unsigned v)
        : from(static_cast<std::uint8_t>(edge.from)),
          to(static_cast<std::uint8_t>(edge.to)),
          opposite(static_cast<std::uint8_t>(edge.opposite)),
          acrossEdge(static_cast<std::uint8_t>(
              static_cast<unsigned>(edge.from < v) & static_cast<unsigned>(edge.to < v) &
              static_cast<unsigned>(edge.opposite < v))) {}
};

/// What decoding the triangles of a cluster carries from one to the next. Kept in locals of one function: stores
/// through byte pointers may alias every member, so members would be reloaded all the time.
struct ConnectivityState {
    const std::uint8_t* indices = nullptr;
    const std::uint8_t* indicesEnd = nullptr;
    unsigned vertexCount = 0;
    unsigned next = 0; // the next new vertex, at most vertexCount
    unsigned isBad = 0;
    EdgeWindow window;
};

using ParentTable = std::array<Parents, 257>; // by vertex; one more for what is written before it is known to be new

inline Triangle enteredTriangle(unsigned code, ConnectivityState& state, ParentTable& parents) {
    const unsigned age = code >> 4U;
    state.isBad |= static_cast<unsigned>(age >= state.window.count());
    const OpenEdge edge = state.window.recent(age);
    const unsigned low = code & 15U;
    const auto isNew = static_cast<unsigned>(low == 0);
    const auto isExplicit = static_cast<unsigned>(low == kExplicit);
    // By masks, since a compiler makes a branch of a choice.
    const unsigned third = (*state.indices & (0U - isExplicit)) | ((state.next - low) & (isExplicit - 1U));
    parents[state.next] = Parents(edge, state.next);
    const auto isThere = static_cast<unsigned>(third < state.vertexCount);
    state.isBad |= isThere ^ 1U;
    state.next += isNew & isThere;
    state.indices += isExplicit;
    state.window.pushTriangle(edge.from, edge.to, third & 0xFFU, true);
    return {static_cast<std::uint8_t>(edge.from), static_cast<std::uint8_t>(edge.to), static_cast<std::uint8_t>(third)};
}

inline Triangle unenteredTriangle(unsigned code, ConnectivityState& state, ParentTable& parents) {
    Triangle triangle{};
    for (unsigned k = 0; k < 3; ++k) {
        const bool isNew = (code >> k & 1U) != 0;
        const bool isThere = isNew ? state.next < state.vertexCount : state.indices < state.indicesEnd;
        const unsigned corner = isNew ? state.next : *state.indices;
        if (!isThere || corner >= state.vertexCount) {
            state.isBad = 1;
            continue;
        }
        parents[state.next].acrossEdge = 0;
        state.next += static_cast<unsigned>(isNew);
        state.indices += static_cast<unsigned>(!isNew);
        triangle[k] = static_cast<std::uint8_t>(corner);
    }
    state.window.pushTriangle(triangle[0], triangle[1], triangle[2], false);
    return triangle;
}

/// Reads the codes of one cluster's triangles and what each of its vertices is predicted from. Moves `indices` on; the
/// byte at `indicesEnd` may be looked at, but not used. Whether a vertex is new is as good as random, so nothing
/// branches on it; what must not happen is noted and told at the end. Throws Damage.
inline void decodeConnectivity(
    std::span<const std::byte> codes,
    std::span<Triangle> triangles,
    std::span<const std::uint8_t>& indices,
    std::uint32_t vertexCount,
    ParentTable& parents) {
    ConnectivityState state;
    state.indices = indices.data();
    state.indicesEnd = indices.data() + indices.size();
    state.vertexCount = vertexCount;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto code = static_cast<unsigned>(codes[t]);
        triangles[t] = (code >> 4U) == kNotEntered ? unenteredTriangle(code, state, parents)
                                                   : enteredTriangle(code, state, parents);
        if (state.indices > state.indicesEnd) throw Damage{"a triangle has a corner that is not there"};
    }
    if (state.isBad != 0) throw Damage{"a triangle has a corner or an edge that is not there"};
    for (unsigned v = state.next; v < vertexCount; ++v)
        parents[v].acrossEdge = 0;
    indices = indices.subspan(static_cast<std::size_t>(state.indices - indices.data()));
}

/// Writes the codes of one cluster's triangles.
class ConnectivityEncoder {
public:
    ConnectivityEncoder(ByteWriter& codes, ByteWriter& indices) : codes_(codes), indices_(indices) {}

    void encode(std::span<const Triangle> triangles) {
        for (const Triangle& triangle : triangles)
            encode(triangle);
    }

    /// By vertex.
    const ParentTable& parents() const { return parents_; }

private:
    void encode(const Triangle& t) {
        const unsigned ages = std::min(window_.count(), kNotEntered);
        for (unsigned age = 0; age < ages; ++age) {
            const OpenEdge edge = window_.recent(age);
            if (edge.from != t[0] || edge.to != t[1]) continue;
            codes_.put(static_cast<std::uint8_t>(age << 4U | third(t[2], edge)));
            window_.pushTriangle(t[0], t[1], t[2], true);
            return;
        }
        unsigned code = kNotEntered << 4U;
        for (unsigned k = 0; k < 3; ++k) {
            if (t[k] == next_) {
                code |= 1U << k;
                ++next_;
            } else {
                indices_.put(t[k]);
            }
        }
        codes_.put(static_cast<std::uint8_t>(code));
        window_.pushTriangle(t[0], t[1], t[2], false);
    }

    unsigned third(std::uint8_t corner, const OpenEdge& edge) {
        if (corner == next_) {
            parents_[next_] = Parents(edge, next_);
            ++next_;
            return 0;
        }
        if (corner < next_ && next_ - corner < kExplicit) return next_ - corner;
        indices_.put(corner);
        return kExplicit;
    }

    ByteWriter& codes_;
    ByteWriter& indices_;
    unsigned next_ = 0;
    EdgeWindow window_;
    ParentTable parents_{};
};

} // namespace gnomon::hierarchy
