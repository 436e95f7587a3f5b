// Traverses a bounding volume tree and tests its boxes against an error rule and several convex volumes at once.
#pragma once

#include "core/convex_volume.h"
#include "lod/tree.h"

#include <bit>
#include <cstdint>

namespace gnomon::lod {

/// Max number of convex volumes in one traversal. Each volume has one bit of a mask.
constexpr std::size_t kMaxVolumes = 64;

/// The convex volumes that may intersect a box (`touching`) and that certainly contain the box (`inside`), one bit per
/// volume. `inside` is a subset of `touching`. The bits are conservative, as in gnomon::classify.
struct VolumeMask {
    std::uint64_t touching = 0;
    std::uint64_t inside = 0;

    /// Returns the volumes that may intersect the box without containing it. Smaller boxes inside the box must be
    /// tested against these volumes.
    std::uint64_t undecided() const { return touching & ~inside; }

    bool operator==(const VolumeMask&) const = default;
};

/// Returns the mask of a box that may intersect each of `count` volumes, but is certainly inside none.
VolumeMask undecidedMask(std::size_t count);

/// Returns the mask of the box `part`, which is inside a larger box with the mask `mask`. Only the volumes that may
/// cross the larger box are tested.
VolumeMask narrowed(VolumeMask mask, std::span<const ConvexVolume> volumes, const Box& part);

namespace detail {

/// The planes of convex volumes in single precision, with margins that make box tests conservative.
class PreparedVolumes {
public:
    PreparedVolumes(std::span<const ConvexVolume> volumes, double reach);

    /// Tests the boxes of the eight children of `node` against the volumes. `mask` is the mask of the node, and
    /// `result` receives the masks of the children.
    void classify(const Node& node, VolumeMask mask, std::array<VolumeMask, kWidth>& result) const;

private:
    struct FloatPlane {
        std::array<float, 3> normal{};
        std::array<float, 3> size{}; // absolute components of `normal`
        float offset = 0;
        float margin = 0;
    };

    std::vector<FloatPlane> planes_;
    std::vector<std::uint32_t> first_; // index of the first plane of each volume, and the total number of planes
};

} // namespace detail

/// Calls `visit(item, mask)` for each item whose box intersects one of `volumes` and for which `matters(bounds, error)`
/// is true. `matters` must be monotone: if it is true for a sphere and an error, it must also be true for an enclosing
/// sphere and a larger error. Because of rounding, the function can visit additional items near the volumes, but it
/// misses no item.
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

} // namespace gnomon::lod
