#include "preprocess/simplify/partners.h"

#include "preprocess/proximity/point_tree.h"
#include "preprocess/simplify/union_find.h"

namespace gnomon::simplify {

namespace {

constexpr std::uint32_t kSmallPiece = 24; // positions

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
    const proximity::PointTree tree(patch.positions, pieces);
    partners.assign(count, hierarchy::kNone);
    for (const std::uint32_t p : looking)
        partners[p] = tree.nearest(patch.positions[p], pieces[p]);
    return partners;
}

} // namespace gnomon::simplify
