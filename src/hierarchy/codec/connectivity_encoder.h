// Encodes the triangles of a cluster.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/connectivity_code.h"
#include "hierarchy/codec/edge_window.h"
#include "hierarchy/page.h"

#include <algorithm>
#include <array>
#include <span>

namespace gnomon::hierarchy {

/// The three corners that predict the position of a vertex by a parallelogram. The previous vertex predicts all
/// vertices without such corners.
struct Parents {
    std::uint8_t from = 0;
    std::uint8_t to = 0;
    std::uint8_t opposite = 0;
    std::uint8_t acrossEdge = 0; // 1 if the vertex was new across an edge, otherwise 0

    Parents() = default;

    /// Stores the three corners that predict vertex `v`: the ends of `edge`, across which it was new, and the opposite
    /// corner. They are valid only if all three come before `v`.
    Parents(const OpenEdge& edge, unsigned v)
        : from(static_cast<std::uint8_t>(edge.from)),
          to(static_cast<std::uint8_t>(edge.to)),
          opposite(static_cast<std::uint8_t>(edge.opposite)),
          acrossEdge(static_cast<std::uint8_t>(
              static_cast<unsigned>(edge.from < v) & static_cast<unsigned>(edge.to < v) &
              static_cast<unsigned>(edge.opposite < v))) {}
};

// The predicting corners of each vertex of a cluster. The additional entry receives writes before a vertex is known to
// be new.
using ParentTable = std::array<Parents, 257>;

/// Writes the codes of the triangles of one cluster.
class ConnectivityEncoder {
public:
    ConnectivityEncoder(ByteWriter& codes, ByteWriter& indices) : codes_(codes), indices_(indices) {}

    void encode(std::span<const Triangle> triangles) {
        for (const Triangle& triangle : triangles)
            encode(triangle);
    }

    /// Returns the predictors of each vertex.
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
