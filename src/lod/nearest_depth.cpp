#include "lod/nearest_depth.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lod {

namespace {

constexpr double kMargin = 0.05;

/// Returns the view pyramid of `view`, widened by the fraction kMargin.
ConvexVolume widenedPyramid(DetailView view) {
    view.tanHalfX *= 1 + kMargin;
    view.tanHalfY *= 1 + kMargin;
    return viewPyramid(view);
}

double minDepth(const Box& box, const DetailView& view) {
    const glm::dvec3 nearest(
        view.basis.view.x > 0 ? box.min.x : box.max.x,
        view.basis.view.y > 0 ? box.min.y : box.max.y,
        view.basis.view.z > 0 ? box.min.z : box.max.z);
    return glm::dot(nearest - view.eye, view.basis.view);
}

Box boxOf(const lod::Node& node, std::size_t lane) {
    return {
        {node.min[0][lane], node.min[1][lane], node.min[2][lane]},
        {node.max[0][lane], node.max[1][lane], node.max[2][lane]}};
}

} // namespace

double nearestDepth(const PageTrees& trees, const DetailView& view) {
    double best = std::numeric_limits<double>::infinity();
    const lod::Tree& tree = trees.levels().back().tree;
    if (tree.isEmpty()) return best;
    const ConvexVolume pyramid = widenedPyramid(view);

    struct Waiting {
        double depth;
        std::uint32_t node;
    };

    std::vector<Waiting> waiting{{0, 0}};
    while (!waiting.empty()) {
        const Waiting next = waiting.back();
        waiting.pop_back();
        if (next.depth >= best) continue;
        const lod::Node& node = tree.nodes()[next.node];
        const std::size_t first = waiting.size();
        for (std::size_t lane = 0; lane < node.count; ++lane) {
            const Box box = boxOf(node, lane);
            const double depth = std::max(minDepth(box, view), 0.0);
            if (depth >= best || classify(pyramid, box) == Containment::Outside) continue;
            if ((node.leaves >> lane & 1U) != 0)
                best = depth;
            else
                waiting.push_back({depth, node.child[lane]});
        }
        // Sorts the nodes that wait for a visit, so that the nearest node is visited first.
        std::sort(
            waiting.begin() + static_cast<std::ptrdiff_t>(first),
            waiting.end(),
            [](const Waiting& a, const Waiting& b) { return a.depth > b.depth; });
    }
    return best * (1 - kMargin);
}

} // namespace gnomon::lod
