#include "culling/penumbra_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::culling {

namespace {

/// A box as the light sees it: a rectangle across its direction, and from where to where it reaches along it.
struct BeamBox {
    glm::dvec2 least{std::numeric_limits<double>::infinity()};
    glm::dvec2 most{-std::numeric_limits<double>::infinity()};
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(const BeamBox& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }

    glm::dvec2 middle() const { return 0.5 * (least + most); }
};

/// Space with the light along one axis.
class BeamSpace {
public:
    explicit BeamSpace(const glm::dvec3& towards) : along_(towards) {
        glm::dvec3 other(0);
        other[std::abs(towards.x) < 0.5 ? 0 : 1] = 1;
        right_ = glm::normalize(glm::cross(other, towards));
        up_ = glm::cross(towards, right_);
    }

    BeamBox boxOf(const Box& box) const {
        const glm::dvec3 middle = box.center();
        const glm::dvec3 half = 0.5 * box.extent();
        const auto reach = [&](const glm::dvec3& axis) { return glm::dot(glm::abs(axis), half); };
        const glm::dvec2 across(glm::dot(right_, middle), glm::dot(up_, middle));
        const glm::dvec2 size(reach(right_), reach(up_));
        const double height = glm::dot(along_, middle);
        return {across - size, across + size, height - reach(along_), height + reach(along_)};
    }

private:
    glm::dvec3 along_;
    glm::dvec3 right_{0};
    glm::dvec3 up_{0};
};

/// Boxes in a binary tree without links: node i has the children 2 i + 1 and 2 i + 2.
class BeamBoxTree {
public:
    explicit BeamBoxTree(std::vector<BeamBox> boxes) : boxes_(std::move(boxes)) {
        if (boxes_.empty()) return;
        std::size_t leaves = 1;
        while (leaves < boxes_.size())
            leaves *= 2;
        nodes_.resize(2 * leaves - 1);
        build(0, 0, boxes_.size(), leaves);
    }

    /// The most that any box stands before `receiver` whose penumbra can fall on it; at least `best`.
    double farthestBefore(const BeamBox& receiver, double slope, double best) const {
        if (!boxes_.empty()) visit(0, receiver, slope, best);
        return best;
    }

private:
    void build(std::size_t node, std::size_t begin, std::size_t end, std::size_t leaves) {
        for (std::size_t i = begin; i < end; ++i)
            nodes_[node].add(boxes_[i]);
        if (leaves == 1 || begin == end) return;
        const glm::dvec2 size = nodes_[node].most - nodes_[node].least;
        const int axis = size.x >= size.y ? 0 : 1;
        const std::size_t half = std::min(begin + leaves / 2, end);
        const auto at = [&](std::size_t i) { return boxes_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(half), at(end), [axis](const BeamBox& a, const BeamBox& b) {
            return a.middle()[axis] < b.middle()[axis];
        });
        build(2 * node + 1, begin, half, leaves / 2);
        build(2 * node + 2, half, end, leaves / 2);
    }

    void visit(std::size_t node, const BeamBox& receiver, double slope, double& best) const {
        const BeamBox& box = nodes_[node];
        const double before = box.high - receiver.low;
        if (!(before > best)) return;
        const double spread = 0.5 * slope * before;
        for (int axis = 0; axis < 2; ++axis)
            if (box.most[axis] < receiver.least[axis] - spread || box.least[axis] > receiver.most[axis] + spread)
                return;
        if (2 * node + 1 >= nodes_.size()) {
            best = before;
            return;
        }
        visit(2 * node + 1, receiver, slope, best);
        visit(2 * node + 2, receiver, slope, best);
    }

    std::vector<BeamBox> boxes_;
    std::vector<BeamBox> nodes_;
};

template <class Use>
void forEachClusterBox(const selection::CutQuery& query, const selection::DrawList& list, const Use& use) {
    const hierarchy::Grid& grid = query.trees->grid();
    for (const selection::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            use(grid.local(page.clusters[c].box));
    }
}

} // namespace

double widestPenumbra(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    std::span<const selection::DrawList> casters,
    const DiscLight& light,
    double nearest) {
    const BeamSpace space(light.towards);
    std::vector<BeamBox> boxes;
    const auto keep = [&](const Box& box) { boxes.push_back(space.boxOf(box)); };
    forEachClusterBox(query, image, keep);
    for (const selection::DrawList& list : casters)
        forEachClusterBox(query, list, keep);
    const BeamBoxTree tree(std::move(boxes));
    const selection::DetailView& view = query.rule->view();
    // How much longer a length may be seen than at the middle of the image.
    const double aslant = std::sqrt(1 + view.tanHalfX * view.tanHalfX + view.tanHalfY * view.tanHalfY);
    const double pixelSlope = 2 * view.tanHalfY / view.heightPixels;
    const ConvexVolume pyramid = selection::viewPyramid(view);
    double widest = 0;
    forEachClusterBox(query, image, [&](const Box& box) {
        if (classify(pyramid, box) == Containment::Outside) return;
        const double reach = glm::dot(glm::abs(view.basis.view), 0.5 * box.extent());
        const double depth = std::max(glm::dot(view.basis.view, box.center() - view.eye) - reach, nearest);
        if (!(depth > 0)) return;
        const double perDistance = light.slope * aslant / (pixelSlope * depth);
        widest = perDistance * tree.farthestBefore(space.boxOf(box), light.slope, widest / perDistance);
    });
    return widest;
}

} // namespace gnomon::culling
