#include "preprocess/build/living_patch.h"

#include "preprocess/build/partners.h"

#include <algorithm>

namespace gnomon::preprocess {

using hierarchy::kNone;

LivingPatch::LivingPatch(const Patch& patch)
    : patch_(patch), vertex_(patch.triangles), alive_(patch.triangles.size()), partner_(nearestInOtherPieces(patch)) {
    const std::size_t positions = patch.positions.size();
    position_.reserve(vertex_.size());
    firstNormal_.reserve(vertex_.size());
    for (const Triangle& t : vertex_) {
        const Triangle& p = position_.emplace_back(patch.corners(t));
        const glm::dvec3& a = patch.positions[p[0]];
        firstNormal_.push_back(glm::cross(patch.positions[p[1]] - a, patch.positions[p[2]] - a));
    }
    isAlive_.assign(vertex_.size(), 1);
    stamp_.assign(positions, 0);
    movedTo_.resize(positions);
    for (std::uint32_t p = 0; p < positions; ++p)
        movedTo_[p] = p;
    linkCorners();
    findEdges();
}

void LivingPatch::linkCorners() {
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

EdgeKind LivingPatch::kindOfEdge(std::uint32_t corner) const {
    const std::uint32_t t = corner / 3;
    const std::uint32_t i = corner % 3;
    const std::uint32_t b = position_[t][(i + 1) % 3];
    EdgeKind kind = EdgeKind::Open;
    for (std::uint32_t other = head_[position_[t][i]]; other != kNone; other = next_[other]) {
        const std::uint32_t u = other / 3;
        if (u == t) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (position_[u][k] != b) continue;
            if (vertex_[u][k] != vertex_[t][(i + 1) % 3] || vertex_[u][other % 3] != vertex_[t][i])
                return EdgeKind::Crease;
            kind = EdgeKind::Smooth;
        }
    }
    return kind;
}

void LivingPatch::findEdges() {
    isBorder_.assign(patch_.positions.size(), 0);
    firstEdge_.reserve(next_.size());
    for (std::uint32_t corner = 0; corner < next_.size(); ++corner) {
        const EdgeKind kind = kindOfEdge(corner);
        firstEdge_.push_back(kind);
        if (kind != EdgeKind::Open) continue;
        const Triangle& t = position_[corner / 3];
        const std::uint32_t a = t[corner % 3];
        const std::uint32_t b = t[(corner % 3 + 1) % 3];
        if (patch_.isLocked[a] == 0 || patch_.isLocked[b] == 0) isBorder_[a] = isBorder_[b] = 1;
    }
}

std::size_t LivingPatch::commonNeighbours(std::uint32_t a, std::uint32_t b) {
    stampNow_ += 2;
    const std::uint32_t seen = stampNow_;
    const std::uint32_t counted = stampNow_ - 1;
    forCorners(a, [&](std::uint32_t corner) {
        for (const std::uint32_t q : position_[corner / 3])
            stamp_[q] = seen;
    });
    stamp_[a] = stamp_[b] = counted;
    std::size_t common = 0;
    forCorners(b, [&](std::uint32_t corner) {
        for (const std::uint32_t q : position_[corner / 3]) {
            if (stamp_[q] != seen) continue;
            stamp_[q] = counted;
            ++common;
        }
    });
    return common;
}

void LivingPatch::join(std::uint32_t from, std::uint32_t to) {
    if (head_[from] != kNone) {
        (head_[to] == kNone ? head_[to] : next_[tail_[to]]) = head_[from];
        tail_[to] = tail_[from];
        head_[from] = kNone;
    }
    isBorder_[to] |= isBorder_[from];
    movedTo_[from] = to;
    if (!partner_.empty() && partner_[to] == kNone && patch_.isLocked[to] == 0) partner_[to] = partner_[from];
}

std::span<const LivingPatch::Doubled> LivingPatch::doubled(std::uint32_t p) {
    sides_.clear();
    doubled_.clear();
    forCorners(p, [&](std::uint32_t corner) {
        const Triangle& t = position_[corner / 3];
        const std::uint32_t a = t[(corner % 3 + 1) % 3];
        const std::uint32_t b = t[(corner % 3 + 2) % 3];
        sides_.push_back({std::min(a, b), std::max(a, b), corner / 3});
    });
    std::sort(sides_.begin(), sides_.end());
    const auto locked = [&](std::uint32_t q) { return patch_.isLocked[q] != 0 ? 1 : 0; };
    std::size_t first = 0;
    for (std::size_t i = 1; i < sides_.size(); ++i) {
        if (sides_[i][0] != sides_[first][0] || sides_[i][1] != sides_[first][1]) {
            first = i;
            continue;
        }
        if (locked(p) + locked(sides_[i][0]) + locked(sides_[i][1]) > 1) continue;
        doubled_.push_back({sides_[first][2], sides_[i][2]});
    }
    return doubled_;
}

} // namespace gnomon::preprocess
