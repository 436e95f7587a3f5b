#include "preprocess/simplify/vertex_pairs.h"

#include "preprocess/proximity/point_tree.h"
#include "preprocess/simplify/union_find.h"

namespace gnomon::simplify {

namespace {

constexpr std::uint32_t kSmallComponent = 24; // max number of positions of a small component

} // namespace

std::vector<std::uint32_t> vertexPairs(const Patch& patch) {
    const auto count = static_cast<std::uint32_t>(patch.positions.size());
    UnionFind sets(count);
    for (const Triangle& t : patch.triangles) {
        const Triangle p = patch.corners(t);
        sets.unite(p[0], p[1]);
        sets.unite(p[1], p[2]);
    }
    std::vector<std::uint32_t> pairs;
    if (sets.count() <= 1) return pairs;
    std::vector<std::uint32_t> component(count);
    for (std::uint32_t p = 0; p < count; ++p)
        component[p] = sets.root(p);
    std::vector<std::uint32_t> size(count, 0);
    for (const std::uint32_t id : component)
        ++size[id];
    // Only positions of small components search for a partner (a nearby position of another component). A position of a
    // large component would first visit all positions of its own component.
    std::vector<std::uint32_t> querying;
    for (std::uint32_t p = 0; p < count; ++p)
        if (patch.isLocked[p] == 0 && size[component[p]] <= kSmallComponent) querying.push_back(p);
    if (querying.empty()) return pairs;
    const proximity::PointTree tree(patch.positions, component);
    pairs.assign(count, hierarchy::kNone);
    for (const std::uint32_t p : querying)
        pairs[p] = tree.nearest(patch.positions[p], component[p]);
    return pairs;
}

} // namespace gnomon::simplify
