#include "lod/traversal.h"

#include "core/check.h"

#include <cmath>

namespace gnomon::lod {

VolumeMask undecidedMask(std::size_t count) {
    GNOMON_CHECK_OP(count, <=, kMaxVolumes);
    return {count == kMaxVolumes ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1, 0};
}

VolumeMask narrowed(VolumeMask mask, std::span<const ConvexVolume> volumes, const Box& part) {
    for (std::uint64_t left = mask.undecided(); left != 0; left &= left - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(left));
        switch (gnomon::classify(volumes[bit], part)) {
        case Containment::Outside:
            mask.touching &= ~(std::uint64_t{1} << bit);
            break;
        case Containment::Inside:
            mask.inside |= std::uint64_t{1} << bit;
            break;
        case Containment::Intersecting:
            break;
        }
    }
    return mask;
}

namespace detail {

PreparedVolumes::PreparedVolumes(std::span<const ConvexVolume> volumes, double reach) {
    first_.push_back(0);
    for (const ConvexVolume& volume : volumes) {
        for (const Plane& plane : volume.planes) {
            FloatPlane& prepared = planes_.emplace_back();
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                prepared.normal[a] = static_cast<float>(plane.normal[axis]);
                prepared.size[a] = std::abs(prepared.normal[a]);
            }
            prepared.offset = static_cast<float>(plane.offset);
            // The margin covers a dozen rounding errors of summands of at most this size.
            prepared.margin = static_cast<float>(16 * 0x1.0p-24 * (6 * reach + std::abs(plane.offset)));
        }
        first_.push_back(static_cast<std::uint32_t>(planes_.size()));
    }
}

void PreparedVolumes::classify(const Node& node, VolumeMask mask, std::array<VolumeMask, kWidth>& result) const {
    result.fill(mask);
    for (std::uint64_t left = mask.undecided(); left != 0; left &= left - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(left));
        std::array<float, kWidth> outside{}; // min of (middle + reach) over the planes
        std::array<float, kWidth> inside{};  // min of (middle - reach) over the planes
        outside.fill(HUGE_VALF);
        inside.fill(HUGE_VALF);
        for (std::uint32_t p = first_[bit]; p < first_[bit + 1]; ++p) {
            const FloatPlane& plane = planes_[p];
            for (std::size_t lane = 0; lane < kWidth; ++lane) {
                // Twice the distance of the box's centre and twice the half extent of the box are computed, which
                // avoids a division by two.
                const float middle = plane.normal[0] * (node.max[0][lane] + node.min[0][lane]) +
                                     plane.normal[1] * (node.max[1][lane] + node.min[1][lane]) +
                                     plane.normal[2] * (node.max[2][lane] + node.min[2][lane]) + 2 * plane.offset;
                const float size = plane.size[0] * (node.max[0][lane] - node.min[0][lane]) +
                                   plane.size[1] * (node.max[1][lane] - node.min[1][lane]) +
                                   plane.size[2] * (node.max[2][lane] - node.min[2][lane]);
                outside[lane] = std::min(outside[lane], middle + size + plane.margin);
                inside[lane] = std::min(inside[lane], middle - size - plane.margin);
            }
        }
        for (std::size_t lane = 0; lane < kWidth; ++lane) {
            const std::uint64_t flag = std::uint64_t{1} << bit;
            if (outside[lane] < 0) result[lane].touching &= ~flag;
            if (inside[lane] >= 0) result[lane].inside |= flag;
        }
    }
}

} // namespace detail
} // namespace gnomon::lod
