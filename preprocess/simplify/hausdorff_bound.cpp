#include "preprocess/simplify/hausdorff_bound.h"

#include "preprocess/simplify/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::simplify {

namespace {

using hierarchy::kNone;

constexpr std::size_t kMaxCorners = 24;
constexpr std::uint32_t kMaxCrossings = 24; // max consecutive cuts from one triangle to the next
constexpr std::uint32_t kMaxHalvings = 12;  // max halvings of a piece if cuts at edges do not reduce its error
constexpr std::uint32_t kMaxPieces = 1024;  // max pieces per triangle

/// A list of points in a fixed array. Its copy constructor copies only the used points, because this is faster than
/// copying the array.
class Corners { // NOLINT(cppcoreguidelines-pro-type-member-init): the values behind the last point are undefined
public:
    Corners() = default; // NOLINT(cppcoreguidelines-pro-type-member-init): the values are undefined

    Corners(const Corners& other) { *this = other; } // NOLINT(cppcoreguidelines-pro-type-member-init): as above

    Corners(Corners&&) = delete;
    ~Corners() = default;

    Corners& operator=(const Corners& other) {
        count_ = other.count_;
        std::copy_n(other.points_.begin(), count_, points_.begin());
        return *this;
    }

    Corners& operator=(Corners&&) = delete;

    void add(const glm::dvec3& p) { points_[count_++] = p; }

    void clear() { count_ = 0; }

    std::uint32_t count() const { return count_; }

    const glm::dvec3& operator[](std::size_t i) const { return points_[i]; }

private:
    // The array is larger than kMaxCorners, because rounding can make a plane cross more than two sides.
    std::array<glm::dvec3, 2 * kMaxCorners> points_;
    std::uint32_t count_ = 0;
};

/// A convex piece of a triangle of one surface. It is assigned to a nearby triangle of the other surface, its
/// containing triangle.
struct Piece {
    Corners corners;
    std::uint32_t container = kNone;
    std::uint32_t crossings = 0;
    std::uint32_t halvings = 0;
};

/// The two parts of a piece that a plane cuts. In one part dot(p - point, normal) is at most 0, in the other at least
/// 0.
struct Halves {
    Piece inside;
    Piece outside;
};

Halves cut(const Piece& piece, const glm::dvec3& point, const glm::dvec3& normal) {
    Halves halves;
    for (Piece* half : {&halves.inside, &halves.outside}) {
        half->container = piece.container;
        half->crossings = piece.crossings + 1;
        half->halvings = piece.halvings;
    }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the loop sets the used entries
    std::array<double, 2 * kMaxCorners> side;
    double minSide = 0;
    double maxSide = 0;
    for (std::uint32_t i = 0; i < piece.corners.count(); ++i) {
        side[i] = glm::dot(piece.corners[i] - point, normal);
        minSide = std::min(minSide, side[i]);
        maxSide = std::max(maxSide, side[i]);
    }
    for (std::uint32_t i = 0; i < piece.corners.count(); ++i) {
        const std::uint32_t next = (i + 1) % piece.corners.count();
        if (side[i] <= 0) halves.inside.corners.add(piece.corners[i]);
        if (side[i] >= 0) halves.outside.corners.add(piece.corners[i]);
        if ((side[i] < 0 && side[next] > 0) || (side[i] > 0 && side[next] < 0)) {
            const double share = side[i] / (side[i] - side[next]);
            const glm::dvec3 crossing = piece.corners[i] + (piece.corners[next] - piece.corners[i]) * share;
            halves.inside.corners.add(crossing);
            halves.outside.corners.add(crossing);
        }
    }
    // A piece that lies completely in the plane belongs only to the inside half.
    if (maxSide <= 0)
        halves.outside.corners.clear();
    else if (minSide >= 0)
        halves.inside.corners.clear();
    return halves;
}

/// The corner of a piece that is farthest from the triangle to which the piece is assigned.
struct Farthest {
    double square = -1;
    proximity::TriangleFeature feature = proximity::TriangleFeature::Face;
    std::uint32_t corner = 0;
};

Farthest farthestFrom(const Surface& surface, const Piece& piece, std::uint32_t triangle) {
    Farthest farthest;
    const proximity::PreparedTriangle container = surface.prepared(triangle);
    for (std::uint32_t i = 0; i < piece.corners.count(); ++i) {
        const proximity::TriangleDistance f = container.distanceTo(piece.corners[i]);
        if (f.square > farthest.square) farthest = {f.square, f.feature, i};
    }
    return farthest;
}

/// Cuts triangles into pieces. Assigns each piece to a nearby triangle of another surface, its containing triangle.
class Refinement {
public:
    Refinement(Surface& surface, double goal) : surface_(surface), acceptedError_(goal) {}

    /// Cuts the triangle `whole` into pieces and calls `assign(container, error)` for each piece. The containing
    /// triangle of `whole` is the start of the search. The error of a piece is its distance from its containing
    /// triangle plus `before(container)`.
    template <class Before, class Assign>
    void run(const Piece& whole, Before before, Assign assign) {
        pieces_ = 0;
        stack_.assign(1, whole);
        while (!stack_.empty()) {
            const Piece piece = stack_.back();
            stack_.pop_back();
            const Farthest farthest = farthestFrom(surface_, piece, piece.container);
            const double error = std::sqrt(farthest.square) + before(piece.container);
            if (error <= acceptedError_ || pieces_ >= kMaxPieces ||
                !(refineAcross(piece, farthest) || refineByHalving(piece, farthest))) {
                acceptedError_ = std::max(acceptedError_, error);
                assign(piece.container, error);
                ++pieces_;
            }
        }
    }

private:
    /// Cuts `piece` at an edge of its containing triangle, and assigns the outer part to the triangle across this edge.
    /// Returns false if no triangle across an edge is nearer to the farthest corner of the piece.
    bool refineAcross(const Piece& piece, const Farthest& farthest) {
        if (piece.crossings >= kMaxCrossings || piece.corners.count() + 2 > kMaxCorners ||
            farthest.feature == proximity::TriangleFeature::Face)
            return false;
        const auto place = static_cast<std::uint32_t>(farthest.feature);
        std::array<std::uint32_t, 2> edges{place - 1, place - 1};
        if (farthest.feature >= proximity::TriangleFeature::Corner0) edges = {place - 4, (place - 4 + 2) % 3};
        double best = farthest.square;
        std::uint32_t bestEdge = kNone;
        for (const std::uint32_t edge : edges) {
            const std::uint32_t other = surface_.across(piece.container, edge);
            if (other == kNone) continue;
            const glm::dvec3& corner = piece.corners[farthest.corner];
            // A corner on the inner side of the bisecting plane would return to its containing triangle, and the loop
            // would not end.
            if (glm::dot(corner - surface_.corner(piece.container, edge), bisector(piece.container, edge)) <= 0)
                continue;
            const double square = surface_.squaredDistance(corner, other);
            if (square < best) {
                best = square;
                bestEdge = edge;
            }
        }
        return bestEdge != kNone && cross(piece, bestEdge);
    }

    bool cross(const Piece& piece, std::uint32_t edge) {
        const std::uint32_t other = surface_.across(piece.container, edge);
        const glm::dvec3& from = surface_.corner(piece.container, edge);
        Halves halves = cut(piece, from, bisector(piece.container, edge));
        halves.outside.container = other;
        // All corners of the piece are on the inner side of the bisecting plane, but they are nearer to the other
        // triangle.
        if (halves.outside.corners.count() < 3) {
            if (piece.crossings > 2) return false;
            halves.inside.container = other;
            halves.inside.crossings = piece.crossings + 1;
        }
        if (halves.inside.corners.count() >= 3) stack_.push_back(halves.inside);
        if (halves.outside.corners.count() >= 3) stack_.push_back(halves.outside);
        return true;
    }

    /// Refines a piece for which the neighbours of its containing triangle are not nearer. The function assigns the
    /// piece to the nearest triangle of the whole surface. If one triangle is not enough, it halves the piece.
    bool refineByHalving(const Piece& piece, const Farthest& farthest) {
        const glm::dvec3& corner = piece.corners[farthest.corner];
        const std::uint32_t nearest = surface_.nearest(corner);
        if (surface_.squaredDistance(corner, nearest) > farthest.square * 0.8) return false;
        Piece moved = piece;
        moved.container = nearest;
        // The limit of halvings is slightly above kMaxHalvings, so that the loop ends.
        if (piece.halvings < kMaxHalvings + 4 &&
            farthestFrom(surface_, moved, nearest).square < farthest.square * 0.8) {
            moved.halvings += 1;
            moved.crossings = 0;
            stack_.push_back(moved);
            return true;
        }
        if (piece.halvings >= kMaxHalvings) return false;
        if (piece.corners.count() + 2 > kMaxCorners) return splitAlongDiagonal(piece);
        const glm::dvec3 across = corner - farthestCorner(piece, corner);
        Halves halves = cut(piece, corner - across * 0.5, across);
        halves.outside.container = nearest;
        for (Piece* half : {&halves.inside, &halves.outside}) {
            if (half->corners.count() < 3) return false;
            half->crossings = 0;
            half->halvings = piece.halvings + 1;
        }
        stack_.push_back(halves.inside);
        stack_.push_back(halves.outside);
        return true;
    }

    /// Returns the corner of `piece` that is farthest from the point `p`.
    static glm::dvec3 farthestCorner(const Piece& piece, const glm::dvec3& p) {
        std::uint32_t farthest = 0;
        for (std::uint32_t i = 1; i < piece.corners.count(); ++i)
            if (proximity::squaredLength(piece.corners[i] - p) > proximity::squaredLength(piece.corners[farthest] - p))
                farthest = i;
        return piece.corners[farthest];
    }

    /// Splits `piece` along a diagonal into two pieces with half of the corners each, because it has too many corners
    /// for another cut.
    bool splitAlongDiagonal(const Piece& piece) {
        Piece first = piece;
        Piece second = piece;
        first.corners.clear();
        second.corners.clear();
        const std::uint32_t middle = piece.corners.count() / 2;
        for (std::uint32_t i = 0; i <= middle; ++i)
            first.corners.add(piece.corners[i]);
        for (std::uint32_t i = middle; i <= piece.corners.count(); ++i)
            second.corners.add(piece.corners[i % piece.corners.count()]);
        for (Piece* half : {&first, &second}) {
            half->crossings = 0;
            half->halvings = piece.halvings + 1;
            stack_.push_back(*half);
        }
        return true;
    }

    /// Returns the normal of a plane through the edge `edge` of `triangle`. The plane bisects the angle between the
    /// triangle and its neighbour at this edge. The normal points away from `triangle`.
    glm::dvec3 bisector(std::uint32_t triangle, std::uint32_t edge) const {
        const glm::dvec3 along = surface_.corner(triangle, (edge + 1) % 3) - surface_.corner(triangle, edge);
        const glm::dvec3 normal = unitNormal(triangle);
        const glm::dvec3 otherNormal = unitNormal(surface_.across(triangle, edge));
        // The orientations of neighbouring triangles may be opposite.
        const double turn = glm::dot(normal, otherNormal) < 0 ? -1.0 : 1.0;
        return glm::cross(along, normal + otherNormal * turn);
    }

    glm::dvec3 unitNormal(std::uint32_t t) const {
        const glm::dvec3 normal =
            glm::cross(surface_.corner(t, 1) - surface_.corner(t, 0), surface_.corner(t, 2) - surface_.corner(t, 0));
        const double length = glm::length(normal);
        return length > 0 ? normal / length : glm::dvec3(0);
    }

    Surface& surface_;
    double acceptedError_; // the goal, or the largest error that was accepted; pieces below it are not cut further
    std::uint32_t pieces_ = 0;
    std::vector<Piece> stack_;
};

Piece wholeTriangle(const Surface& surface, std::uint32_t t, std::uint32_t container) {
    Piece piece;
    for (std::size_t i = 0; i < 3; ++i)
        piece.corners.add(surface.corner(t, i));
    piece.container = container;
    return piece;
}

glm::dvec3 centerOf(const Surface& surface, std::uint32_t t) {
    return (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) * (1.0 / 3);
}

void growTo(float& bound, double value) {
    bound = std::max(bound, roundedUp(value));
}

class Measurement {
public:
    Measurement(const Patch& patch, const SimplifiedPatch& simplified)
        : patch_(patch),
          simplified_(simplified),
          fine_(patch.positions, fineCorners(patch)),
          coarse_(patch.positions, coarseCorners(patch, simplified)),
          successor_(patch.triangles.size(), kNone),
          isSame_(patch.triangles.size(), 0) {
        result_.errors.resize(simplified.triangles.size());
    }

    HausdorffBound run(double goal) {
        std::vector<std::uint8_t> isDone(result_.errors.size(), 0);
        for (std::uint32_t t = 0; t < result_.errors.size(); ++t) {
            const std::uint32_t origin = simplified_.origin[t];
            if (origin == kNone) continue;
            successor_[origin] = t;
            if (fine_.triangles()[origin] != coarse_.triangles()[t]) continue;
            isSame_[origin] = isDone[t] = 1;
            result_.errors[t] = patch_.error(origin);
        }
        Refinement onFine(fine_, goal);
        for (std::uint32_t t = 0; t < result_.errors.size(); ++t) {
            if (isDone[t] != 0) continue;
            if (!simplified_.errors.empty() && double{simplified_.errors[t].toSource} <= goal) {
                result_.errors[t].toSource = simplified_.errors[t].toSource;
                continue;
            }
            const std::uint32_t origin = simplified_.origin[t];
            const std::uint32_t container = origin != kNone ? origin : fine_.nearest(centerOf(coarse_, t));
            onFine.run(
                wholeTriangle(coarse_, t, container),
                [&](std::uint32_t on) { return static_cast<double>(patch_.error(on).toSource); },
                [&](std::uint32_t /*on*/, double error) { growTo(result_.errors[t].toSource, error); });
        }
        Refinement onCoarse(coarse_, goal);
        for (std::uint32_t t = 0; t < successor_.size(); ++t) {
            if (isSame_[t] != 0) continue;
            const double before = patch_.error(t).fromSource;
            onCoarse.run(
                wholeTriangle(fine_, t, firstTriangle(t)),
                [&](std::uint32_t /*on*/) { return before; },
                [&](std::uint32_t on, double error) { growTo(result_.errors[on].fromSource, error); });
        }
        for (const TriangleError& error : result_.errors)
            result_.worst = std::max({result_.worst, double{error.fromSource}, double{error.toSource}});
        return std::move(result_);
    }

private:
    static std::vector<Triangle> fineCorners(const Patch& patch) {
        std::vector<Triangle> corners;
        corners.reserve(patch.triangles.size());
        for (const Triangle& t : patch.triangles)
            corners.push_back(patch.corners(t));
        return corners;
    }

    static std::vector<Triangle> coarseCorners(const Patch& patch, const SimplifiedPatch& simplified) {
        std::vector<Triangle> corners;
        corners.reserve(simplified.triangles.size());
        for (const Triangle& t : simplified.triangles)
            corners.push_back(simplified.corners(patch, t));
        return corners;
    }

    /// Returns a simplified triangle near triangle `t` of the original patch. The search for the nearest triangle
    /// starts there.
    std::uint32_t firstTriangle(std::uint32_t t) {
        if (successor_[t] != kNone) return successor_[t];
        const glm::dvec3 center = centerOf(fine_, t);
        double best = std::numeric_limits<double>::infinity();
        std::uint32_t container = kNone;
        for (const std::uint32_t p : fine_.triangles()[t])
            for (const std::uint32_t candidate : coarse_.around(simplified_.movedTo[p])) {
                const double square = coarse_.squaredDistance(center, candidate);
                if (square < best) {
                    best = square;
                    container = candidate;
                }
            }
        return container != kNone ? container : coarse_.nearest(center);
    }

    const Patch& patch_;
    const SimplifiedPatch& simplified_;
    Surface fine_;
    Surface coarse_;
    std::vector<std::uint32_t> successor_; // per original triangle: the simplified triangle that it became
    std::vector<std::uint8_t> isSame_;
    HausdorffBound result_;
};

} // namespace

HausdorffBound measureHausdorffBound(const Patch& patch, const SimplifiedPatch& simplified, double goal) {
    return Measurement(patch, simplified).run(goal);
}

} // namespace gnomon::simplify
