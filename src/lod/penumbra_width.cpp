#include "lod/penumbra_width.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace gnomon::lod {

namespace {

/// The bounding box of geometry as seen from the light: a rectangle perpendicular to the light direction, and a range
/// along this direction.
struct BeamBox {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(const BeamBox& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }

    glm::dvec2 middle() const { return 0.5 * (min + max); }
};

/// A coordinate system with one axis along the light direction.
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

/// A bounding box hierarchy over casters, as an implicit binary tree: the children of node i are nodes 2 i + 1 and 2 i
/// + 2.
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

    /// Returns the max distance, along the light, between `receiver` and a caster whose penumbra can fall on it.
    /// Returns `best` if `best` is larger. `slope` is the width of a penumbra per unit of distance.
    double farthestBefore(const BeamBox& receiver, double slope, double best) const {
        if (!boxes_.empty()) visit(0, receiver, slope, best);
        return best;
    }

private:
    void build(std::size_t node, std::size_t begin, std::size_t end, std::size_t leaves) {
        for (std::size_t i = begin; i < end; ++i)
            nodes_[node].add(boxes_[i]);
        if (leaves == 1 || begin == end) return;
        const glm::dvec2 size = nodes_[node].max - nodes_[node].min;
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
            if (box.max[axis] < receiver.min[axis] - spread || box.min[axis] > receiver.max[axis] + spread) return;
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

void forEachClusterBox(const lod::CutQuery& query, const lod::DrawList& list, const auto& use) {
    const hierarchy::Grid& grid = query.trees->grid();
    for (const lod::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            use(grid.local(page.clusters[c].box));
    }
}

/// A rectangle of the image, in pixels from the lower left corner.
struct SeenRectangle {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

/// Returns the image rectangle that contains the part of `box` whose view depth is at least `depth`. If the whole box
/// has such depths, its corners bound the rectangle. Otherwise the rectangle contains all combinations of offset and
/// depth.
SeenRectangle seenRectangle(const lod::DetailView& view, const TiledView& seen, const Box& box, double depth) {
    const glm::dvec2 size(seen.tiles.width, seen.tiles.height);
    SeenRectangle offsets; // perpendicular to the view, world units
    SeenRectangle rectangle;
    const auto add = [&](const glm::dvec2& across, double at) {
        rectangle.add((across / (seen.half * at) + 1.0) / 2.0 * size);
    };
    bool reachesNearer = false;
    double deepest = depth;
    for (unsigned corner = 0; corner < 8; ++corner) {
        glm::dvec3 point = box.min;
        for (int axis = 0; axis < 3; ++axis)
            if ((corner >> static_cast<unsigned>(axis) & 1U) != 0) point[axis] = box.max[axis];
        const glm::dvec3 way = point - view.eye;
        const double at = glm::dot(view.basis.view, way);
        reachesNearer |= at < depth * (1 - 1e-9);
        deepest = std::max(deepest, at);
        const glm::dvec2 across(glm::dot(view.basis.right, way), glm::dot(view.basis.up, way));
        offsets.add(across);
        add(across, seen.isParallel ? 1 : at);
    }
    if (seen.isParallel || !reachesNearer) return rectangle;
    rectangle = {};
    for (const glm::dvec2& across : {offsets.min, offsets.max})
        for (const double at : {depth, deepest})
            add(across, at);
    return rectangle;
}

/// A rectangle of image tiles from `min` to `max`, without the tiles at `max`.
struct TileBox {
    glm::ivec2 min{0};
    glm::ivec2 max{0};
};

/// Returns the image tiles that may show a part of `box`. The nearest point of the box has view depth `depth`.
TileBox tilesOf(const lod::DetailView& view, const TiledView& seen, const Box& box, double depth) {
    constexpr double kTileMargin = 1; // pixels: half a pixel, and a reserve for rounding
    const SeenRectangle rectangle = seenRectangle(view, seen, box, depth);
    const glm::ivec2 tiles(seen.tiles.columns(), seen.tiles.rows());
    const auto tileAt = [&](const glm::dvec2& pixel) {
        const glm::dvec2 tile = glm::floor(pixel / double{shadow::ImageTiles::kSide});
        return glm::ivec2(glm::clamp(tile, glm::dvec2(-1), glm::dvec2(tiles)));
    };
    return {
        glm::clamp(tileAt(rectangle.min - kTileMargin), glm::ivec2(0), tiles),
        glm::clamp(tileAt(rectangle.max + kTileMargin) + 1, glm::ivec2(0), tiles)};
}

/// The max penumbra width per image tile, in pixels.
class TileWidths {
public:
    explicit TileWidths(const shadow::ImageTiles& tiles) : tiles_(tiles), widths_(tiles.count()) {}

    /// Returns the min penumbra width over the tiles of `box`, or infinity if `box` is empty.
    double min(const TileBox& box) const {
        double min = std::numeric_limits<double>::infinity();
        forEach(box, [&](std::size_t i) { min = std::min(min, widths_[i]); });
        return min;
    }

    void raise(const TileBox& box, double width) {
        forEach(box, [&](std::size_t i) { widths_[i] = std::max(widths_[i], width); });
    }

    void add(const TileWidths& other) {
        for (std::size_t i = 0; i < widths_.size(); ++i)
            widths_[i] = std::max(widths_[i], other.widths_[i]);
    }

    std::vector<double> take() { return std::move(widths_); }

private:
    template <class Use>
    void forEach(const TileBox& box, const Use& use) const {
        for (int y = box.min.y; y < box.max.y; ++y)
            for (int x = box.min.x; x < box.max.x; ++x)
                use(static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_.columns()) +
                    static_cast<std::size_t>(x));
    }

    shadow::ImageTiles tiles_;
    std::vector<double> widths_;
};

/// Computes upper bounds of penumbra widths on the visible surfaces. The search first tests clusters. If the bound of a
/// cluster is too coarse, it tests the triangles of the cluster.
class WidthSearch {
public:
    WidthSearch(const lod::CutQuery& query, const BeamBoxTree& casters, const DiscLight& light, const TiledView& seen)
        : query_(&query),
          view_(&query.rule->view()),
          casters_(&casters),
          light_(&light),
          seen_(&seen),
          space_(light.towards),
          pyramid_(lod::viewPyramid(*view_)) {
        // Max factor by which a length appears larger than at the centre of the image.
        const double aslant = std::sqrt(1 + view_->tanHalfX * view_->tanHalfX + view_->tanHalfY * view_->tanHalfY);
        perDistance_ = light.slope * aslant * view_->heightPixels / (2 * view_->tanHalfY);
    }

    void look(const lod::ClusterRange& range, TileWidths& widths) const {
        const hierarchy::Page& page = *query_->resident[range.page];
        const hierarchy::Grid& grid = query_->trees->grid();
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            const Box box = grid.local(cluster.box);
            if (classify(pyramid_, box) == Containment::Outside) continue;
            if (!isWider(box, widths)) continue;
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
                std::array<glm::dvec3, 3> corners{};
                for (std::size_t i = 0; i < 3; ++i)
                    corners[i] = grid.local(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
                if (mayShowLight(corners)) take(corners, widths);
            }
        }
    }

private:
    /// The position of a receiver in the image and in the coordinate system along the light.
    struct Receiver {
        TileBox tiles;
        BeamBox beam;
        // penumbra width in pixels per unit of distance to the caster; 0 if the receiver is not visible
        double perDistance = 0;
    };

    Receiver receiver(const Box& box) const {
        const double reach = glm::dot(glm::abs(view_->basis.view), 0.5 * box.extent());
        const double middle = glm::dot(view_->basis.view, box.center() - view_->eye);
        const double depth = std::max(middle - reach, seen_->nearest);
        if (!(depth > 0) || middle + reach < depth * (1 - 1e-9)) return {};
        return {tilesOf(*view_, *seen_, box, depth), space_.boxOf(box), perDistance_ / depth};
    }

    /// Returns true if a penumbra on the receiver `box` may be wider than the widths that `widths` stores for its
    /// tiles.
    bool isWider(const Box& box, const TileWidths& widths) const {
        const Receiver found = receiver(box);
        if (found.perDistance == 0) return false;
        const double known = widths.min(found.tiles) / found.perDistance;
        return casters_->farthestBefore(found.beam, light_->slope, known) > known;
    }

    void take(const std::array<glm::dvec3, 3>& corners, TileWidths& widths) const {
        Box box;
        for (const glm::dvec3& corner : corners)
            box.add(corner);
        const Receiver found = receiver(box);
        if (found.perDistance == 0) return;
        const double known = widths.min(found.tiles) / found.perDistance;
        const double before = casters_->farthestBefore(found.beam, light_->slope, known);
        if (before > known) widths.raise(found.tiles, before * found.perDistance);
    }

    /// Returns true if light from a part of the sun's disc can reach the side of a triangle that the eye may see.
    bool mayShowLight(const std::array<glm::dvec3, 3>& corners) const {
        constexpr double kGrazing = 1e-6; // rounding error of a sine from these products
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 towardsEye = seen_->isParallel ? -view_->basis.view : view_->eye - corners[0];
        const double light = glm::dot(normal, light_->towards);
        const double eye = glm::dot(normal, towardsEye);
        const double size = glm::length(normal);
        if (std::abs(light) <= (0.5 * light_->slope + kGrazing) * size) return true;
        if (std::abs(eye) <= kGrazing * size * glm::length(towardsEye)) return true;
        return (light > 0) == (eye > 0);
    }

    const lod::CutQuery* query_;
    const lod::DetailView* view_;
    const BeamBoxTree* casters_;
    const DiscLight* light_;
    const TiledView* seen_;
    BeamSpace space_;
    ConvexVolume pyramid_;
    double perDistance_ = 0; // penumbra width in pixels per unit of distance to the caster, at view depth 1
};

} // namespace

std::vector<double> penumbraWidths(
    const lod::CutQuery& query,
    const lod::DrawList& image,
    std::span<const lod::DrawList> casters,
    const DiscLight& light,
    const TiledView& seen) {
    const BeamSpace space(light.towards);
    std::vector<BeamBox> boxes;
    const auto keep = [&](const Box& box) { boxes.push_back(space.boxOf(box)); };
    forEachClusterBox(query, image, keep);
    for (const lod::DrawList& list : casters)
        forEachClusterBox(query, list, keep);
    const BeamBoxTree tree(std::move(boxes));
    const WidthSearch search(query, tree, light, seen);
    // Each thread computes its own max widths, so the assignment of work to threads does not change the result.
    tbb::enumerable_thread_specific<TileWidths> widths(seen.tiles);
    tbb::parallel_for(
        std::size_t{0}, image.ranges.size(), [&](std::size_t i) { search.look(image.ranges[i], widths.local()); });
    TileWidths all(seen.tiles);
    for (const TileWidths& each : widths)
        all.add(each);
    return all.take();
}

} // namespace gnomon::lod
