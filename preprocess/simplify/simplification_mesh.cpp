#include "preprocess/simplify/simplification_mesh.h"

#include "preprocess/simplify/vertex_pairs.h"

#include <algorithm>

namespace gnomon::simplify {

using hierarchy::kNone;

SimplificationMesh::SimplificationMesh(const Patch& patch)
    : patch_(patch), vertex_(patch.triangles), triangleCount_(patch.triangles.size()), pair_(vertexPairs(patch)) {
    const std::size_t positions = patch.positions.size();
    position_.reserve(vertex_.size());
    originalNormal_.reserve(vertex_.size());
    for (const Triangle& t : vertex_) {
        const Triangle& p = position_.emplace_back(patch.corners(t));
        const glm::dvec3& a = patch.positions[p[0]];
        originalNormal_.push_back(glm::cross(patch.positions[p[1]] - a, patch.positions[p[2]] - a));
    }
    isRemoved_.assign(vertex_.size(), 0);
    stamp_.assign(positions, 0);
    neighbours_.resize(positions + 1);
    mergedInto_.resize(positions);
    for (std::uint32_t p = 0; p < positions; ++p)
        mergedInto_[p] = p;
    linkCorners();
    findEdges();
}

void SimplificationMesh::linkCorners() {
    head_.assign(patch_.positions.size(), kNone);
    tail_.assign(patch_.positions.size(), kNone);
    next_.assign(position_.size() * 3, kNone);
    for (std::uint32_t corner = 0; corner < next_.size(); ++corner) {
        const std::uint32_t p = position_[corner / 3][corner % 3];
        if (head_[p] == kNone)
            head_[p] = corner;
        else
            next_[tail_[p]] = corner;
        tail_[p] = corner;
    }
}

/// Records each edge from position `a` in `spokes`, with the vertices of the triangles at this edge.
void SimplificationMesh::gatherSpokes(std::uint32_t a, std::vector<Spoke>& spokes) const {
    for (std::uint32_t corner = head_[a]; corner != kNone; corner = next_[corner])
        for (const std::uint32_t place : kOthers[corner % 3]) {
            Spoke& spoke = spokes[position_[corner / 3][place]];
            const std::uint64_t here = vertex_[corner / 3][corner % 3];
            const std::uint64_t vertices = here << 32U | vertex_[corner / 3][place];
            // The code has no branches, because the CPU cannot predict whether an edge was already found.
            const std::uint64_t kept = spoke.seenFrom == a ? ~std::uint64_t{0} : 0;
            spoke.seenFrom = a;
            spoke.triangles = (spoke.triangles & static_cast<std::uint32_t>(kept)) + 1;
            spoke.first = (spoke.first & kept) | (vertices & ~kept);
            spoke.differs = (spoke.differs & kept) | (vertices ^ spoke.first);
        }
}

void SimplificationMesh::findEdges() {
    isBorder_.assign(patch_.positions.size(), 0);
    originalEdge_.resize(next_.size());
    std::vector<Spoke> spokes(patch_.positions.size());
    for (std::uint32_t a = 0; a < head_.size(); ++a) {
        gatherSpokes(a, spokes);
        for (std::uint32_t corner = head_[a]; corner != kNone; corner = next_[corner]) {
            const std::uint32_t b = position_[corner / 3][kOthers[corner % 3][0]];
            const Spoke& spoke = spokes[b];
            const bool isOpen = spoke.triangles == 1;
            originalEdge_[corner] = isOpen ? EdgeKind::Open : spoke.differs != 0 ? EdgeKind::Crease : EdgeKind::Smooth;
            if (isOpen && (patch_.isLocked[a] == 0 || patch_.isLocked[b] == 0)) isBorder_[a] = isBorder_[b] = 1;
        }
    }
}

std::size_t SimplificationMesh::commonNeighbours(std::uint32_t a, std::uint32_t b) {
    stampNow_ += 2;
    const std::uint32_t seen = stampNow_;
    const std::uint32_t counted = stampNow_ - 1;
    forEachCorner(a, [&](std::uint32_t corner) {
        for (const std::uint32_t q : position_[corner / 3])
            stamp_[q] = seen;
    });
    stamp_[a] = stamp_[b] = counted;
    std::size_t common = 0;
    forEachCorner(b, [&](std::uint32_t corner) {
        for (const std::uint32_t q : position_[corner / 3]) {
            if (stamp_[q] != seen) continue;
            stamp_[q] = counted;
            ++common;
        }
    });
    return common;
}

void SimplificationMesh::merge(std::uint32_t from, std::uint32_t to) {
    if (head_[from] != kNone) {
        (head_[to] == kNone ? head_[to] : next_[tail_[to]]) = head_[from];
        tail_[to] = tail_[from];
        head_[from] = kNone;
    }
    isBorder_[to] |= isBorder_[from];
    mergedInto_[from] = to;
    if (!pair_.empty() && pair_[to] == kNone && patch_.isLocked[to] == 0) pair_[to] = pair_[from];
}

bool SimplificationMesh::hasEqualOppositeEdges() const {
    unsigned found = 0;
    for (std::size_t i = 1; i < oppositeEdges_.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) // no branches, because two edges are almost never equal
            found |=
                ((oppositeEdges_[i][0] ^ oppositeEdges_[k][0]) | (oppositeEdges_[i][1] ^ oppositeEdges_[k][1])) == 0
                    ? 1U
                    : 0U;
    return found != 0;
}

std::span<const SimplificationMesh::Duplicate> SimplificationMesh::duplicates(std::uint32_t p) {
    oppositeEdges_.clear();
    duplicates_.clear();
    forEachCorner(p, [&](std::uint32_t corner) {
        const Triangle& t = position_[corner / 3];
        const std::uint32_t a = t[(corner % 3 + 1) % 3];
        const std::uint32_t b = t[(corner % 3 + 2) % 3];
        oppositeEdges_.push_back({std::min(a, b), std::max(a, b), corner / 3});
    });
    constexpr std::size_t kMaxCompared = 16; // up to this number of edges, comparing all pairs is faster than sorting
    if (oppositeEdges_.size() <= kMaxCompared && !hasEqualOppositeEdges()) return duplicates_;
    std::sort(oppositeEdges_.begin(), oppositeEdges_.end());
    const auto locked = [&](std::uint32_t q) { return patch_.isLocked[q] != 0 ? 1 : 0; };
    std::size_t first = 0;
    for (std::size_t i = 1; i < oppositeEdges_.size(); ++i) {
        if (oppositeEdges_[i][0] != oppositeEdges_[first][0] || oppositeEdges_[i][1] != oppositeEdges_[first][1]) {
            first = i;
            continue;
        }
        if (locked(p) + locked(oppositeEdges_[i][0]) + locked(oppositeEdges_[i][1]) > 1) continue;
        duplicates_.push_back({oppositeEdges_[first][2], oppositeEdges_[i][2]});
    }
    return duplicates_;
}

} // namespace gnomon::simplify
