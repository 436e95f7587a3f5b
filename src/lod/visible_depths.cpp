#include "lod/visible_depths.h"

#include "core/check.h"
#include "lod/triangle_clip.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

namespace gnomon::lod {
namespace {

/// A range of view depths divided into steps.
class DepthQuantization {
public:
    explicit DepthQuantization(const DepthSpan& depths) : depths_(depths) {
        const double steps = std::floor(std::log2(depths.far / depths.near) * kSpansPerOctave);
        isEven_ = steps < 1 && depths.far > depths.near;
        count_ = isEven_ ? std::size_t{kSpansPerOctave} : static_cast<std::size_t>(steps) + 1;
    }

    std::size_t count() const { return count_; }

    std::size_t step(double depth) const {
        if (!(depth > depths_.near)) return 0;
        const double part =
            isEven_ ? (depth - depths_.near) / (depths_.far - depths_.near) : std::log2(depth / depths_.near);
        const double step = std::floor(part * kSpansPerOctave);
        return static_cast<std::size_t>(std::min(step, static_cast<double>(count_ - 1)));
    }

    DepthSpan span(std::size_t i) const { return {edge(i), edge(i + 1)}; }

private:
    double edge(std::size_t i) const {
        if (i == count_) return depths_.far;
        const double part = static_cast<double>(i) / kSpansPerOctave;
        return isEven_ ? depths_.near + (depths_.far - depths_.near) * part : depths_.near * std::exp2(part);
    }

    DepthSpan depths_;
    bool isEven_ = false; // true: the depth range is smaller than a step and is divided evenly
    std::size_t count_ = 1;
};

/// Steps of view depth, with a mark for each step that contains a lit surface. Threads only set marks, so the result
/// does not depend on their order.
class DepthSteps {
public:
    explicit DepthSteps(const DepthSpan& depths) : steps_(depths), marks_(steps_.count()) {}

    bool isMarked(double minDepth, double maxDepth) const {
        for (std::size_t i = steps_.step(minDepth); i <= steps_.step(maxDepth); ++i)
            if (!marks_[i].load(std::memory_order_relaxed)) return false;
        return true;
    }

    void mark(double minDepth, double maxDepth) {
        for (std::size_t i = steps_.step(minDepth); i <= steps_.step(maxDepth); ++i)
            marks_[i].store(true, std::memory_order_relaxed);
    }

    std::vector<DepthSpan> spans() const {
        std::vector<DepthSpan> result;
        for (std::size_t i = 0; i < marks_.size(); ++i) {
            if (!marks_[i].load(std::memory_order_relaxed)) continue;
            if (i > 0 && marks_[i - 1].load(std::memory_order_relaxed)) {
                result.back().far = steps_.span(i).far;
            } else {
                result.push_back(steps_.span(i));
            }
        }
        return result;
    }

private:
    DepthQuantization steps_;
    std::vector<std::atomic<bool>> marks_;
};

/// Returns the range of view depths of a box in the model's local space.
DepthSpan depthsOf(const lod::DetailView& view, const Box& box) {
    const double middle = glm::dot(view.basis.view, box.center() - view.eye);
    const double reach = glm::dot(glm::abs(view.basis.view), box.extent() * 0.5);
    return {middle - reach, middle + reach};
}

class LitSearch {
public:
    LitSearch(const lod::CutQuery& query, const glm::dvec3& towardsLight, const Box& casters, const DepthSpan& depths)
        : query_(&query),
          towardsLight_(towardsLight),
          casters_(casters),
          pyramid_(lod::viewPyramid(query.rule->view())),
          steps_(depths) {}

    void look(const lod::ClusterRange& range, TriangleClipper& clipper) {
        const hierarchy::Page& page = *query_->resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            look(page, page.clusters[c], clipper);
    }

    const ConvexVolume& pyramid() const { return pyramid_; }

    LitSurfaces found() const { return {steps_.spans(), canBeShadowed_.load()}; }

private:
    double depthOf(const glm::dvec3& point) const {
        const lod::DetailView& view = query_->rule->view();
        return glm::dot(view.basis.view, point - view.eye);
    }

    bool isSettled(const DepthSpan& span) const {
        return canBeShadowed_.load(std::memory_order_relaxed) && steps_.isMarked(span.near, span.far);
    }

    void look(const hierarchy::Page& page, const hierarchy::Cluster& cluster, TriangleClipper& clipper) {
        const hierarchy::Grid& grid = query_->trees->grid();
        if (isSettled(depthsOf(query_->rule->view(), grid.local(cluster.box)))) return;
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
            std::array<glm::dvec3, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = grid.local(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
            look(corners, clipper);
        }
    }

    void look(const std::array<glm::dvec3, 3>& corners, TriangleClipper& clipper) {
        glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::dot(normal, towardsLight_) < 0) normal = -normal;
        const bool isLit =
            glm::dot(normal, towardsLight_) > 0 && glm::dot(normal, query_->rule->view().eye - corners[0]) > 0;
        // the visible side faces away from the light, or the triangle is edge-on to the eye or the light
        if (!isLit) return;
        const auto [nearest, farthest] = std::minmax({depthOf(corners[0]), depthOf(corners[1]), depthOf(corners[2])});
        if (isSettled({nearest, farthest})) return;
        DepthSpan span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
        for (const glm::dvec3& point : clipper.clipped(corners)) {
            span.near = std::min(span.near, depthOf(point));
            span.far = std::max(span.far, depthOf(point));
        }
        if (span.near > span.far) return;
        steps_.mark(span.near, span.far);
        if (isBefore(corners[0], normal)) canBeShadowed_.store(true, std::memory_order_relaxed);
    }

    /// Returns true if the bounding box of all casters extends above the plane through `point` by more than the error
    /// of a vertex that is rounded to the grid.
    bool isBefore(const glm::dvec3& point, const glm::dvec3& normal) const {
        if (casters_.isEmpty()) return false;
        const double highest =
            glm::dot(normal, casters_.center() - point) + glm::dot(glm::abs(normal), casters_.extent() * 0.5);
        return highest > glm::length(normal) * query_->trees->grid().step();
    }

    const lod::CutQuery* query_;
    glm::dvec3 towardsLight_;
    Box casters_;
    ConvexVolume pyramid_;
    DepthSteps steps_;
    std::atomic<bool> canBeShadowed_ = false;
};

/// Returns a box that contains the part of `box` with view depths in `span`. The result can be slightly larger than
/// this part.
Box boxBetween(const lod::DetailView& view, const Box& box, const DepthSpan& span) {
    const glm::dvec3& along = view.basis.view;
    const double eye = glm::dot(along, view.eye);
    Box result = box;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(along[axis]) < 1e-3) continue; // the plane bounds this axis only at a very large distance
        double minDepth = eye + span.near;          // range of along[axis] * x for any values on the other axes
        double maxDepth = eye + span.far;
        for (int other = 0; other < 3; ++other) {
            if (other == axis) continue;
            minDepth -= std::max(along[other] * box.min[other], along[other] * box.max[other]);
            maxDepth -= std::min(along[other] * box.min[other], along[other] * box.max[other]);
        }
        if (along[axis] < 0) std::swap(minDepth, maxDepth);
        result.min[axis] = std::clamp(minDepth / along[axis], box.min[axis], box.max[axis]);
        result.max[axis] = std::clamp(maxDepth / along[axis], result.min[axis], box.max[axis]);
    }
    return result;
}

/// Returns the box of a drawn cluster, extended by the stored error of its refinement.
Box boxWithMargin(const hierarchy::Grid& grid, const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
    const Box box = grid.local(cluster.box);
    const bool isLeaf = cluster.refinement == hierarchy::kNone;
    const glm::dvec3 margin(isLeaf ? 0 : page.refinements[cluster.refinement].error);
    return {box.min - margin, box.max + margin};
}

/// Divides `box` at the borders of the depth steps, and adds each part to the box of its step in `boxes`.
void addParts(
    const lod::DetailView& view,
    const Box& box,
    const DepthQuantization& steps,
    std::span<const DepthSpan> spans,
    std::span<Box> boxes) {
    const DepthSpan span = depthsOf(view, box);
    const std::size_t first = steps.step(span.near);
    const std::size_t last = steps.step(span.far);
    // Parts outside the depth range are added to the first or the last step.
    for (std::size_t i = first; i <= last; ++i)
        boxes[i].add(
            boxBetween(view, box, {i == first ? span.near : spans[i].near, i == last ? span.far : spans[i].far}));
}

} // namespace

LitSurfaces litSurfaces(
    const lod::CutQuery& query,
    const lod::DrawList& image,
    const glm::dvec3& towardsLight,
    const Box& casters,
    const DepthSpan& depths) {
    GNOMON_CHECK(depths.near > 0 && depths.far >= depths.near);
    LitSearch search(query, towardsLight, casters, depths);
    tbb::enumerable_thread_specific<TriangleClipper> clippers([&] { return TriangleClipper(search.pyramid()); });
    tbb::parallel_for(
        std::size_t{0}, image.ranges.size(), [&](std::size_t i) { search.look(image.ranges[i], clippers.local()); });
    return search.found();
}

std::vector<shadow::VisibleSlab> visibleSlabs(
    const lod::CutQuery& query, const lod::DrawList& image, const DepthSpan& depths) {
    GNOMON_CHECK(depths.near > 0 && depths.far >= depths.near);
    const lod::DetailView& view = query.rule->view();
    const ConvexVolume pyramid = lod::viewPyramid(view);
    const DepthQuantization steps(depths);
    std::vector<DepthSpan> spans(steps.count());
    for (std::size_t i = 0; i < spans.size(); ++i)
        spans[i] = steps.span(i);
    // Each thread computes its own boxes. The union of these boxes does not depend on the assignment of work to
    // threads.
    tbb::enumerable_thread_specific<std::vector<Box>> ofThreads(spans.size());
    tbb::parallel_for(std::size_t{0}, image.ranges.size(), [&](std::size_t i) {
        const lod::ClusterRange& range = image.ranges[i];
        const hierarchy::Page& page = *query.resident[range.page];
        std::vector<Box>& boxes = ofThreads.local();
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const Box box = boxWithMargin(query.trees->grid(), page, page.clusters[c]);
            if (classify(pyramid, box) != Containment::Outside) addParts(view, box, steps, spans, boxes);
        }
    });
    std::vector<Box> boxes(spans.size());
    for (const std::vector<Box>& found : ofThreads)
        for (std::size_t i = 0; i < boxes.size(); ++i)
            boxes[i].add(found[i]);
    std::vector<shadow::VisibleSlab> parts;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].isEmpty()) parts.push_back({spans[i], {boxes[i].min - view.eye, boxes[i].max - view.eye}});
    return parts;
}

std::vector<CasterBlock> casterBlocks(const lod::CutQuery& query, const lod::DrawList& list) {
    const hierarchy::Grid& grid = query.trees->grid();
    std::vector<CasterBlock> blocks;
    for (const lod::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t i = 0; i < range.clusterCount; ++i) {
            const hierarchy::Cluster& cluster = page.clusters[range.firstCluster + i];
            if (i % kClustersPerBlock == 0) blocks.emplace_back();
            blocks.back().box.add(boxWithMargin(grid, page, cluster));
            blocks.back().triangles += cluster.triangleCount;
        }
    }
    return blocks;
}

} // namespace gnomon::lod
