// A patch under collapses against a list of triangles in which everything is looked up one by one.
#include "core/random.h"
#include "preprocess/simplify/collapse_star.h"
#include "preprocess/simplify/simplification_mesh.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace gnomon::simplify {
namespace {

constexpr std::uint32_t kPositions = 30;

/// Triangles between random positions, each of which has two vertices: borders, creases, edges of many faces and
/// doubled triangles are all there. Every seventh position is locked. Odd seeds use few positions, so that many of them
/// are on no border.
Patch randomSoup(std::uint64_t seed) {
    Random random(seed);
    Patch patch;
    for (std::uint32_t p = 0; p < kPositions; ++p) {
        const double x = random.unit();
        const double y = random.unit();
        patch.positions.emplace_back(x, y, random.unit());
        patch.isLocked.push_back(p % 7 == 0 ? 1 : 0);
    }
    patch.vertices.resize(std::size_t{kPositions} * 2);
    for (std::uint32_t v = 0; v < patch.vertices.size(); ++v) {
        patch.vertices[v].color = v;
        patch.positionOf.push_back(v / 2);
    }
    const std::uint64_t used = seed % 2 == 1 ? 10 : kPositions;
    while (patch.triangles.size() < 60) {
        Triangle t{};
        for (std::uint32_t& v : t)
            v = static_cast<std::uint32_t>(random.below(used * 2));
        const Triangle p = patch.corners(t);
        if (p[0] != p[1] && p[1] != p[2] && p[2] != p[0]) patch.triangles.push_back(t);
    }
    return patch;
}

using Positions = std::set<std::uint32_t>;

/// The remaining triangles as sets of positions.
using Plain = std::map<std::uint32_t, Positions>;

Plain plainOf(const Patch& patch) {
    Plain plain;
    for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
        const Triangle p = patch.corners(patch.triangles[t]);
        plain[t] = {p[0], p[1], p[2]};
    }
    return plain;
}

void collapsePlainly(Plain& plain, std::uint32_t from, std::uint32_t to) {
    std::erase_if(plain, [&](const auto& face) { return face.second.contains(from) && face.second.contains(to); });
    for (auto& [t, positions] : plain)
        if (positions.erase(from) > 0) positions.insert(to);
}

Positions neighboursIn(const Plain& plain, std::uint32_t p) {
    Positions neighbours;
    for (const auto& [t, positions] : plain)
        if (positions.contains(p)) neighbours.insert(positions.begin(), positions.end());
    neighbours.erase(p);
    return neighbours;
}

/// Triangle and the least one with the same positions, if that is another and no locked edge of both is at `p`.
std::set<std::pair<std::uint32_t, std::uint32_t>> doubledIn(const Plain& plain, const Patch& patch, std::uint32_t p) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> doubled;
    for (const auto& [t, positions] : plain) {
        if (!positions.contains(p)) continue;
        const auto isLocked = [&](std::uint32_t q) { return patch.isLocked[q] != 0; };
        if (std::count_if(positions.begin(), positions.end(), isLocked) > 1) continue;
        const auto first = std::find_if(
            plain.begin(), plain.end(), [&same = positions](const auto& face) { return face.second == same; });
        if (first->first != t) doubled.emplace(first->first, t);
    }
    return doubled;
}

void expectSame(SimplificationMesh& mesh, const Plain& plain, const Patch& patch) {
    ASSERT_EQ(mesh.triangleCount(), plain.size());
    for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
        ASSERT_EQ(!mesh.isRemoved(t), plain.contains(t));
        if (!plain.contains(t)) continue;
        const Triangle& p = mesh.positions(t);
        EXPECT_EQ(Positions(p.begin(), p.end()), plain.at(t));
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(mesh.representative(patch.positionOf[mesh.vertices(t)[i]]), p[i]);
    }
    for (std::uint32_t p = 0; p < kPositions; ++p) {
        const Positions wanted = neighboursIn(plain, p);
        std::vector<std::uint32_t> found;
        for (const std::uint32_t q : mesh.neighbours(p))
            found.push_back(q);
        EXPECT_EQ(found.size(), wanted.size());
        EXPECT_EQ(Positions(found.begin(), found.end()), wanted);
        EXPECT_EQ(mesh.hasTriangles(p), !wanted.empty());
        std::set<std::pair<std::uint32_t, std::uint32_t>> doubled;
        for (const SimplificationMesh::Duplicate& pair : mesh.duplicates(p))
            doubled.emplace(pair.kept, pair.removed);
        EXPECT_EQ(doubled, doubledIn(plain, patch, p));
    }
}

EdgeKind edgeIn(const Patch& patch, std::uint32_t triangle, std::uint32_t a, std::uint32_t b) {
    EdgeKind kind = EdgeKind::Open;
    for (std::uint32_t u = 0; u < patch.triangles.size(); ++u) {
        const Triangle& other = patch.triangles[u];
        const Triangle corners = patch.corners(other);
        if (u == triangle || !has(corners, patch.positionOf[a]) || !has(corners, patch.positionOf[b])) continue;
        if (!has(other, a) || !has(other, b)) return EdgeKind::Crease;
        kind = EdgeKind::Smooth;
    }
    return kind;
}

void expectSameEdges(const SimplificationMesh& mesh, const Patch& patch) {
    std::vector<bool> isBorder(kPositions, false);
    for (std::uint32_t corner = 0; corner < patch.triangles.size() * 3; ++corner) {
        const Triangle& t = patch.triangles[corner / 3];
        const std::uint32_t a = t[corner % 3];
        const std::uint32_t b = t[(corner % 3 + 1) % 3];
        const EdgeKind wanted = edgeIn(patch, corner / 3, a, b);
        EXPECT_EQ(mesh.originalEdge(corner), wanted);
        const std::uint32_t p = patch.positionOf[a];
        const std::uint32_t q = patch.positionOf[b];
        const bool isLocked = patch.isLocked[p] != 0 && patch.isLocked[q] != 0;
        if (wanted == EdgeKind::Open && !isLocked) isBorder[p] = isBorder[q] = true;
    }
    for (std::uint32_t p = 0; p < kPositions; ++p)
        EXPECT_EQ(mesh.isBorder(p), isBorder[p]);
}

/// A collapse in both, and what is asked before and after it.
void collapseBoth(SimplificationMesh& mesh, CollapseStar& star, Plain& plain, std::uint32_t from, std::uint32_t to) {
    const Positions a = neighboursIn(plain, from);
    const Positions b = neighboursIn(plain, to);
    const auto isCommon = [&](std::uint32_t q) { return q != from && q != to && b.contains(q); };
    const auto common = std::count_if(a.begin(), a.end(), isCommon);
    EXPECT_EQ(mesh.commonNeighbours(from, to), static_cast<std::size_t>(common));
    const bool isBorder = mesh.isBorder(from) || mesh.isBorder(to);
    star.gather(from, to);
    star.apply();
    mesh.merge(from, to);
    collapsePlainly(plain, from, to);
    EXPECT_EQ(mesh.isBorder(to), isBorder);
}

TEST(SimplificationMesh, EdgesAreOpenOrCreasesWhereNoOtherTriangleHasThemOrOneHasThemWithOtherVertices) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Patch patch = randomSoup(seed);
        expectSameEdges(SimplificationMesh(patch), patch);
    }
}

TEST(SimplificationMesh, CollapsesInAnyOrderLeaveTheTrianglesThatAListOfThemLeaves) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Patch patch = randomSoup(seed);
        SimplificationMesh mesh(patch);
        CollapseStar star(patch, mesh);
        Plain plain = plainOf(patch);
        std::vector<std::uint32_t> representative(kPositions);
        std::iota(representative.begin(), representative.end(), 0U);
        Random random(seed + 100);
        for (int attempt = 0; attempt < 200; ++attempt) {
            const auto from = static_cast<std::uint32_t>(random.below(kPositions));
            const auto to = static_cast<std::uint32_t>(random.below(kPositions));
            if (from == to || !mesh.isRepresentative(from) || !mesh.hasTriangles(to)) continue;
            collapseBoth(mesh, star, plain, from, to);
            expectSame(mesh, plain, patch);
            std::replace(representative.begin(), representative.end(), from, to);
            for (std::uint32_t p = 0; p < kPositions; ++p)
                EXPECT_EQ(mesh.representative(p), representative[p]);
        }
    }
}

} // namespace
} // namespace gnomon::simplify
