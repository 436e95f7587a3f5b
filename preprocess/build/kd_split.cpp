#include "preprocess/build/kd_split.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace gnomon::preprocess {

namespace {

constexpr std::size_t kParallelItems = 1U << 15U;

using Items = std::span<KdItem>;

std::uint64_t weightOf(Items items) {
    std::uint64_t weight = 0;
    for (const KdItem& item : items)
        weight += item.weight;
    return weight;
}

int widestAxis(Items items) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const KdItem& item : items) {
        low = glm::min(low, item.center);
        high = glm::max(high, item.center);
    }
    const glm::vec3 size = high - low;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

/// Partitions `items`, which weigh `rest`, along `axis` and returns how many lie on the low side: their weight is at
/// most `target`, as near to it as the items allow, and neither side is empty.
std::size_t cutAtWeight(Items items, int axis, std::uint64_t rest, std::uint64_t target) {
    const auto before = [axis](const KdItem& a, const KdItem& b) {
        return a.center[axis] < b.center[axis] || (a.center[axis] == b.center[axis] && a.index < b.index);
    };
    std::size_t low = 0;
    std::size_t high = items.size();
    std::uint64_t weight = 0;
    while (high - low > 1) {
        const std::size_t room = high - low;
        // With equal weights the first guess is right and only its neighbour is looked at besides.
        const double share = static_cast<double>(target - weight) / static_cast<double>(rest);
        const auto guess = static_cast<std::size_t>(share * static_cast<double>(room));
        const std::size_t middle = low + std::clamp<std::size_t>(guess, 1, room - 1);
        const auto begin = items.begin();
        std::nth_element(
            begin + static_cast<std::ptrdiff_t>(low),
            begin + static_cast<std::ptrdiff_t>(middle),
            begin + static_cast<std::ptrdiff_t>(high),
            before);
        const std::uint64_t left = weightOf(items.subspan(low, middle - low));
        if (weight + left == target) return middle;
        if (weight + left < target) {
            weight += left;
            rest -= left;
            low = middle;
        } else {
            rest = left;
            high = middle;
        }
    }
    return std::clamp<std::size_t>(low, 1, items.size() - 1);
}

struct Splitter {
    Items all;
    std::uint64_t maxWeight;
    double fraction;
    std::vector<std::uint8_t>& isEnd;

    void split(std::size_t first, std::size_t count) const {
        const Items items = all.subspan(first, count);
        const std::uint64_t weight = weightOf(items);
        if (count <= 1 || weight <= maxWeight) {
            std::sort(items.begin(), items.end(), [](const KdItem& a, const KdItem& b) { return a.index < b.index; });
            isEnd[first + count - 1] = 1;
            return;
        }
        const std::uint64_t parts = (weight + maxWeight - 1) / maxWeight;
        const auto lowParts = std::clamp<std::uint64_t>(
            static_cast<std::uint64_t>(std::floor(static_cast<double>(parts) * fraction + 0.5)), 1, parts - 1);
        const std::size_t low = cutAtWeight(items, widestAxis(items), weight, weight * lowParts / parts);
        if (count < kParallelItems) {
            split(first, low);
            split(first + low, count - low);
        } else {
            tbb::parallel_invoke([&] { split(first, low); }, [&] { split(first + low, count - low); });
        }
    }
};

} // namespace

std::vector<std::uint32_t> kdSplit(std::vector<KdItem>& items, std::uint64_t maxWeight, double fraction) {
    std::vector<std::uint32_t> ends;
    if (items.empty()) return ends;
    std::vector<std::uint8_t> isEnd(items.size(), 0);
    Splitter{items, maxWeight, fraction, isEnd}.split(0, items.size());
    for (std::uint32_t i = 0; i < items.size(); ++i)
        if (isEnd[i] != 0) ends.push_back(i + 1);
    return ends;
}

} // namespace gnomon::preprocess
