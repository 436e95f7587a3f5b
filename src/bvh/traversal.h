// The walk through a tree by several convex volumes and one error rule at a time.
#pragma once

#include "bvh/tree.h"
#include "core/convex_volume.h"

#include <bit>
#include <cstdint>

namespace gnomon::bvh {

/// At most this many volumes in one walk: a bit each.
constexpr std::size_t kMaxVolumes = 64;

/// How a box lies to a set of volumes, one bit each. `inside` is a part of `touching`; conservative as `classify` is.
struct VolumeMask {
    std::uint64_t touching = 0;
    std::uint64_t inside = 0;

    /// The volumes against which a part of the box must still be tested.
    std::uint64_t undecided() const { return touching & ~inside; }

    bool operator==(const VolumeMask&) const = default;
};

/// The mask of a box that touches every one of `count` volumes and of which nothing more is known.
VolumeMask undecidedMask(std::size_t count);

/// `mask` of a box narrowed to a part of it, `part`: only undecided volumes are tested.
VolumeMask narrowed(VolumeMask mask, std::span<const ConvexVolume> volumes, const Box& part);

namespace detail {

/// The planes of the volumes in floats with a margin that makes every float test conservative.
class PreparedVolumes {
public:
    PreparedVolumes(std::span<const ConvexVolume> volumes, double reach);

    /// Masks of the eight children of `node`, given the node's own.
    void classify(const Node& node, VolumeMask mask, std::array<VolumeMask, kWidth>& result) const;

private:
    struct FloatPlane {
        std::array<float, 3> normal{};
        std::array<float, 3> size{}; // |normal|
        float offset = 0;
        float margin = 0;
    };

    std::vector<FloatPlane> planes_;
    std::vector<std::uint32_t> first_; // of each volume; one more at the end
};

} // namespace detail

/// Calls `visit(item, mask)` for the items whose box touches at least one of `volumes` and for which
/// `matters(bounds, error)` holds. `matters` must be monotone: true for a sphere and error wherever it is true for a
/// sphere within and a smaller error. A few items more than exact tests would let through are visited, never fewer.
template <class Matters, class Visit>
void traverse(const Tree& tree, std::span<const ConvexVolume> volumes, const Matters& matters, const Visit& visit) {
    if (tree.isEmpty() || volumes.empty()) return;
    const detail::PreparedVolumes prepared(volumes, tree.reach());

    struct Entry {
        std::uint32_t node = 0;
        VolumeMask mask;
    };

    std::vector<Entry> stack{{0, undecidedMask(volumes.size())}};
    std::array<VolumeMask, kWidth> masks{};
    while (!stack.empty()) {
        const Entry entry = stack.back();
        stack.pop_back();
        const Node& node = tree.nodes()[entry.node];
        prepared.classify(node, entry.mask, masks);
        for (std::size_t lane = node.count; lane-- > 0;) {
            if (masks[lane].touching == 0) continue;
            const Sphere bounds{
                {node.bounds[0][lane], node.bounds[1][lane], node.bounds[2][lane]}, node.bounds[3][lane]};
            if (!matters(bounds, static_cast<double>(node.error[lane]))) continue;
            if ((node.leaves >> lane & 1U) != 0) {
                visit(node.child[lane], masks[lane]);
            } else {
                stack.push_back({node.child[lane], masks[lane]});
            }
        }
    }
}

} // namespace gnomon::bvh
