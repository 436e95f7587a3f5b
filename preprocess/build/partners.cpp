#include "preprocess/build/partners.h"

#include "preprocess/build/union_find.h"

#include <algorithm>
#include <limits>

namespace gnomon::preprocess {

namespace {

constexpr std::uint32_t kSmallPiece = 24; // positions

/// A balanced tree of points in one array: the middle of each range is its node, down to ranges that are searched.
class PointTree {
public:
    PointTree(const std::vector<glm::dvec3>& positions, const std::vector<std::uint32_t>& pieces)
        : positions_(positions), pieces_(pieces), order_(positions.size()), axis_(positions.size(), 0) {
        for (std::uint32_t i = 0; i < order_.size(); ++i)
            order_[i] = i;
        build(0, order_.size());
    }

    std::uint32_t nearest(std::uint32_t position) const {
        Query query{positions_[position], pieces_[position], std::numeric_limits<double>::infinity(), hierarchy::kNone};
        visit(0, order_.size(), query);
        return query.best;
    }

private:
    static constexpr std::size_t kSearched = 8; // of so few points each is looked at

    struct Query {
        glm::dvec3 point;
        std::uint32_t piece;
        double bestSquare;
        std::uint32_t best;
    };

    void build(std::size_t begin, std::size_t end) {
        if (end - begin <= kSearched) return;
        glm::dvec3 low = positions_[order_[begin]];
        glm::dvec3 high = low;
        for (std::size_t i = begin; i < end; ++i) {
            low = glm::min(low, positions_[order_[i]]);
            high = glm::max(high, positions_[order_[i]]);
        }
        const glm::dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::size_t middle = begin + (end - begin) / 2;
        std::nth_element(
            order_.begin() + static_cast<std::ptrdiff_t>(begin),
            order_.begin() + static_cast<std::ptrdiff_t>(middle),
            order_.begin() + static_cast<std::ptrdiff_t>(end),
            [&](std::uint32_t a, std::uint32_t b) {
                return positions_[a][axis] < positions_[b][axis] ||
                       (positions_[a][axis] == positions_[b][axis] && a < b);
            });
        axis_[middle] = static_cast<std::uint8_t>(axis);
        build(begin, middle);
        build(middle + 1, end);
    }

    void consider(std::uint32_t here, Query& query) const {
        if (pieces_[here] == query.piece) return;
        const glm::dvec3 d = positions_[here] - query.point;
        const double square = glm::dot(d, d);
        if (square > query.bestSquare || (square == query.bestSquare && here > query.best)) return;
        query.bestSquare = square;
        query.best = here;
    }

    void visit(std::size_t begin, std::size_t end, Query& query) const {
        if (end - begin <= kSearched) {
            for (std::size_t i = begin; i < end; ++i)
                consider(order_[i], query);
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        const std::uint32_t here = order_[middle];
        consider(here, query);
        const int axis = axis_[middle];
        const double side = query.point[axis] - positions_[here][axis];
        if (side < 0) {
            visit(begin, middle, query);
            if (side * side <= query.bestSquare) visit(middle + 1, end, query);
        } else {
            visit(middle + 1, end, query);
            if (side * side <= query.bestSquare) visit(begin, middle, query);
        }
    }

    const std::vector<glm::dvec3>& positions_;
    const std::vector<std::uint32_t>& pieces_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint8_t> axis_;
};

} // namespace

std::vector<std::uint32_t> nearestInOtherPieces(const Patch& patch) {
    const auto count = static_cast<std::uint32_t>(patch.positions.size());
    UnionFind sets(count);
    for (const Triangle& t : patch.triangles) {
        const Triangle p = patch.corners(t);
        sets.unite(p[0], p[1]);
        sets.unite(p[1], p[2]);
    }
    std::vector<std::uint32_t> partners;
    if (sets.count() <= 1) return partners;
    std::vector<std::uint32_t> pieces(count);
    for (std::uint32_t p = 0; p < count; ++p)
        pieces[p] = sets.root(p);
    std::vector<std::uint32_t> size(count, 0);
    for (const std::uint32_t piece : pieces)
        ++size[piece];
    // A large piece need not look for others, they come to it; its queries would visit all of itself first.
    std::vector<std::uint32_t> looking;
    for (std::uint32_t p = 0; p < count; ++p)
        if (patch.isLocked[p] == 0 && size[pieces[p]] <= kSmallPiece) looking.push_back(p);
    if (looking.empty()) return partners;
    const PointTree tree(patch.positions, pieces);
    partners.assign(count, hierarchy::kNone);
    for (const std::uint32_t p : looking)
        partners[p] = tree.nearest(p);
    return partners;
}

} // namespace gnomon::preprocess
