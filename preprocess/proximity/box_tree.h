// A bounding volume hierarchy of boxes, each with a label. It finds the boxes that overlap a query box and have another
// label.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::proximity {

/// A closed axis-aligned box, initially empty.
struct TreeBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }

    void add(const TreeBox& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }

    bool intersects(const TreeBox& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
               low.z <= other.high.z && other.low.z <= high.z;
    }
};

/// A binary tree of boxes. The boxes are sorted by the Morton codes of their centres. Each inner node divides its boxes
/// into two halves of equal count.
class BoxTree {
public:
    /// Builds the tree over `boxes`, in which box i has the label `labels[i]`. Both arrays must outlive the tree.
    BoxTree(std::span<const TreeBox> boxes, std::span<const std::uint32_t> labels)
        : boxes_(boxes), labels_(labels), order_(boxes.size()) {
        if (order_.empty()) return;
        sortByMortonCode();
        nodes_.reserve(boxes.size());
        build(0, static_cast<std::uint32_t>(order_.size()));
    }

    /// Calls `visit(index)` for each box that overlaps `box` and whose label differs from `label`. The order of the
    /// calls is deterministic.
    template <class Visit>
    void forEachOther(const TreeBox& box, std::uint32_t label, Visit visit) const {
        std::array<std::uint32_t, 64> stack{};
        std::size_t depth = nodes_.empty() ? 0 : 1;
        while (depth > 0) {
            const std::uint32_t index = stack[--depth];
            const Node& node = nodes_[index];
            if ((node.hasOneLabel && node.label == label) || !node.box.intersects(box)) continue;
            if (node.right == 0) {
                for (std::uint32_t i = node.begin; i < node.end; ++i)
                    if (labels_[order_[i]] != label && boxes_[order_[i]].intersects(box)) visit(order_[i]);
                continue;
            }
            stack[depth++] = node.right;
            stack[depth++] = index + 1;
        }
    }

private:
    struct Node {
        TreeBox box;
        std::uint32_t begin;
        std::uint32_t end;
        std::uint32_t right; // index of the second child; the first child follows its parent; 0 for a leaf
        std::uint32_t label; // label of the first box
        bool hasOneLabel;
    };

    void sortByMortonCode() {
        constexpr double kCells = 1023;
        TreeBox middles;
        for (const TreeBox& box : boxes_)
            middles.add(box.low + box.high);
        const glm::dvec3 scale = kCells / glm::max(middles.high - middles.low, glm::dvec3(1e-300));
        std::vector<std::uint64_t> keys(boxes_.size());
        for (std::uint32_t i = 0; i < keys.size(); ++i) {
            const glm::dvec3 cell = (boxes_[i].low + boxes_[i].high - middles.low) * scale;
            const std::uint32_t code = spread(cell.x) | spread(cell.y) << 1U | spread(cell.z) << 2U;
            keys[i] = std::uint64_t{code} << 32U | i;
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 0; i < keys.size(); ++i)
            order_[i] = static_cast<std::uint32_t>(keys[i]);
    }

    /// Returns the lowest ten bits of `cell` with two zero bits between neighbouring bits, as one coordinate of a
    /// Morton code.
    static std::uint32_t spread(double cell) {
        auto bits = static_cast<std::uint32_t>(cell);
        bits = (bits | bits << 16U) & 0x030000FFU;
        bits = (bits | bits << 8U) & 0x0300F00FU;
        bits = (bits | bits << 4U) & 0x030C30C3U;
        return (bits | bits << 2U) & 0x09249249U;
    }

    std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
        constexpr std::uint32_t kLeafBoxes = 4;
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({{}, begin, end, 0, labels_[order_[begin]], true});
        if (end - begin <= kLeafBoxes) {
            Node& leaf = nodes_[index];
            for (std::uint32_t i = begin; i < end; ++i) {
                leaf.box.add(boxes_[order_[i]]);
                leaf.hasOneLabel = leaf.hasOneLabel && labels_[order_[i]] == leaf.label;
            }
            return index;
        }
        const std::uint32_t half = begin + (end - begin) / 2;
        const std::uint32_t left = build(begin, half);
        const std::uint32_t right = build(half, end);
        Node& node = nodes_[index];
        node.right = right;
        for (const Node& child : {nodes_[left], nodes_[right]}) {
            node.box.add(child.box);
            node.hasOneLabel = node.hasOneLabel && child.hasOneLabel && child.label == node.label;
        }
        return index;
    }

    std::span<const TreeBox> boxes_;
    std::span<const std::uint32_t> labels_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace gnomon::proximity
