#include "preprocess/simplify/collapse_star.h"

#include "hierarchy/octahedral.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/color_charge.h"

#include <algorithm>
#include <limits>

namespace gnomon::simplify {

namespace {

using hierarchy::kNone;

constexpr double kMinTurnCosine = 0.25; // a collapse may turn a face by at most 75 degrees

/// Returns the number (0 to 2) of the corner of `t` that is at position `p`. `t` must contain `p`.
std::uint32_t placeOf(std::uint32_t p, const Triangle& t) {
    return t[0] == p ? 0 : (t[1] == p ? 1 : 2);
}

double attributeDistance(const Vertex& a, const Vertex& b) {
    const auto channel = [](std::uint32_t color, std::uint32_t shift) {
        return static_cast<double>(color >> shift & 0xFFU) / 255.0;
    };
    double sum = proximity::squaredLength(hierarchy::unpackNormal(a.normal) - hierarchy::unpackNormal(b.normal));
    for (const std::uint32_t shift : {0U, 8U, 16U, 24U}) {
        const double d = channel(a.color, shift) - channel(b.color, shift);
        sum += d * d;
    }
    return sum;
}

} // namespace

void CollapseStar::gather(std::uint32_t from, std::uint32_t to) {
    from_ = from;
    to_ = to;
    faces_.clear();
    vanishing_ = 0;
    mesh_.forEachCorner(from, [&](std::uint32_t corner) {
        const Triangle& t = mesh_.positions(corner / 3);
        const std::uint32_t i = corner % 3;
        const StarFace face{corner / 3, t[(i + 1) % 3], t[(i + 2) % 3]};
        if (vanishes(face)) ++vanishing_;
        faces_.push_back(face);
    });
}

bool CollapseStar::turnsFace() const {
    const glm::dvec3& origin = patch_.positions[from_];
    const glm::dvec3& target = patch_.positions[to_];
    for (const StarFace& face : faces_) {
        if (vanishes(face)) continue;
        const glm::dvec3& b = patch_.positions[face.b];
        const glm::dvec3 side = patch_.positions[face.c] - b;
        const glm::dvec3 before = glm::cross(side, origin - b);
        const glm::dvec3 after = glm::cross(side, target - b);
        const double square = proximity::squaredLength(before);
        const double turned = glm::dot(before, after);
        if (square > 0 && (turned <= 0 || turned * turned < kMinTurnCosine * kMinTurnCosine * square *
                                                                proximity::squaredLength(after)))
            return true;
        const glm::dvec3& first = mesh_.originalNormal(face.triangle);
        if (glm::dot(first, after) <= 0 && proximity::squaredLength(first) > 0) return true;
    }
    return false;
}

bool CollapseStar::violatesLinkCondition() {
    if (vanishing_ == 0) return true;
    if (vanishing_ > 1 && mesh_.isBorder(from_) && mesh_.isBorder(to_)) return true;
    return mesh_.commonNeighbours(from_, to_) > vanishing_;
}

bool CollapseStar::breaksLockedEdge() {
    if (patch_.isLocked[to_] == 0) return false;
    ends_.clear();
    for (const StarFace& face : faces_) {
        const std::uint32_t isVanishing = vanishes(face) ? 1 : 0;
        if (face.b != to_ && patch_.isLocked[face.b] != 0) ends_.push_back({face.b, isVanishing});
        if (face.c != to_ && patch_.isLocked[face.c] != 0) ends_.push_back({face.c, isVanishing});
    }
    if (ends_.empty()) return false;
    std::sort(ends_.begin(), ends_.end());
    std::int64_t balance = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        balance += ends_[i][1] != 0 ? 1 : -1;
        if (i + 1 < ends_.size() && ends_[i + 1][0] == ends_[i][0]) continue;
        if (balance != 0) return true;
    }
    return false;
}

bool CollapseStar::orderAsFan(Fan& fan) {
    const std::size_t count = faces_.size();
    if (vanishing_ == 0 || vanishing_ > 2 || count < 2 || count >= Fan::kMaxRim) return false;
    fan.count = 0;
    std::uint32_t at = to_;
    for (std::size_t done = 0; done < count; ++done) {
        std::size_t next = done; // faces before index `done` are already in order
        while (next < count && faces_[next].b != at && faces_[next].c != at)
            ++next;
        if (next == count) return false;
        std::swap(faces_[done], faces_[next]);
        const StarFace& face = faces_[done];
        fan.rim[fan.count++] = patch_.positions[at];
        at = face.b == at ? face.c : face.b;
        if (at == to_ && done + 1 < count) return false;
    }
    fan.isClosed = at == to_;
    if (fan.isClosed != (vanishing_ == 2)) return false;
    if (!fan.isClosed) fan.rim[fan.count++] = patch_.positions[at];
    if (fan.count < 3) return false;
    fan.apex = patch_.positions[from_];
    return true;
}

/// Returns the vertex at position `to` that replaces `vertex` after the collapse. If an edge of a vanishing triangle
/// connects `vertex` with a vertex at `to`, the function returns that vertex, because this preserves attribute seams.
/// Otherwise it selects the vertex with the nearest attributes. If the selected vertex has another colour, the function
/// returns `vertex` itself, which moves to `to`. Otherwise the remaining faces, which may be large, would show the
/// colour of another part.
std::uint32_t CollapseStar::replacementOf(std::uint32_t vertex) {
    for (const auto& [removed, kept] : replacements_)
        if (removed == vertex) return kept;
    std::uint32_t best = kNone;
    double nearest = std::numeric_limits<double>::infinity();
    mesh_.forEachCorner(to_, [&](std::uint32_t corner) {
        const std::uint32_t candidate = mesh_.vertices(corner / 3)[corner % 3];
        if (candidate == best) return;
        const double distance = attributeDistance(patch_.vertices[candidate], patch_.vertices[vertex]);
        if (distance < nearest || (distance == nearest && candidate < best)) {
            nearest = distance;
            best = candidate;
        }
    });
    const double difference = colorDifference(patch_.vertices[best].color, patch_.vertices[vertex].color);
    return difference > kOtherPart ? vertex : best;
}

void CollapseStar::apply() {
    replacements_.clear();
    for (const StarFace& face : faces_) {
        if (!vanishes(face)) continue;
        const Triangle& t = mesh_.positions(face.triangle);
        const Triangle& v = mesh_.vertices(face.triangle);
        replacements_.push_back({v[placeOf(from_, t)], v[placeOf(to_, t)]});
    }
    for (const StarFace& face : faces_) {
        if (vanishes(face)) continue;
        const std::uint32_t place = placeOf(from_, mesh_.positions(face.triangle));
        const std::uint32_t removed = mesh_.vertices(face.triangle)[place];
        const std::uint32_t kept = replacementOf(removed);
        replacements_.push_back({removed, kept});
        mesh_.setCorner(3 * face.triangle + place, kept, to_);
    }
    for (const StarFace& face : faces_)
        if (vanishes(face)) mesh_.remove(face.triangle);
}

} // namespace gnomon::simplify
