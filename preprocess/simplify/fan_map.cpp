#include "preprocess/simplify/fan_map.h"

#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::simplify {

namespace {

using Row = std::array<double, Fan::kMaxRim>;

/// Maps the triangles of a fan before a collapse to the triangles after it. For each new triangle it computes the max
/// squared distance by which a corner of a cell of the map moves.
class FanMap {
public:
    explicit FanMap(const Fan& fan) : fan_(fan) {
        maxT_.fill(1);
        placeApex();
        for (std::uint32_t i = host_ + 2; i < fan.count; ++i) {
            double minT = 0;
            for (std::uint32_t j = host_ + 1; j < i; ++j)
                cross(i, j, minT);
        }
        for (std::uint32_t i = host_; i-- > 1;) {
            double minT = 0;
            for (std::uint32_t j = host_; j > i; --j)
                cross(i, j, minT);
        }
    }

    FanAfter after() const {
        FanAfter after;
        spread(fan_.fromSource, after.fromSource);
        spread(fan_.toSource, after.toSource);
        return after;
    }

private:
    /// Finds the triangle after the collapse onto which the apex is mapped, and the distance of the apex from this
    /// triangle.
    void placeApex() {
        const std::uint32_t end = fan_.count - 1;
        if (!fan_.isClosed) { // the border of an open fan is mapped to the new border
            host_ = end - 1;
            square_[host_] = proximity::squaredDistance(fan_.apex, fan_.rim[0], fan_.rim[end]);
            return;
        }
        double best = std::numeric_limits<double>::infinity();
        for (std::uint32_t j = 1; j < end; ++j) {
            const double square = proximity::squaredDistance(fan_.apex, fan_.rim[0], fan_.rim[j], fan_.rim[j + 1]);
            if (square >= best) continue;
            best = square;
            host_ = j;
        }
        square_[host_] = best;
    }

    /// Computes where the old edge from the apex to rim `i` crosses the new edge from rim 0 to rim `j`. The crossing's
    /// parameter on the old edge is at least `minT`.
    void cross(std::uint32_t i, std::uint32_t j, double& minT) {
        const glm::dvec3& pivot = fan_.rim[0];
        const glm::dvec3 spoke = fan_.rim[i] - fan_.apex;
        const glm::dvec3 chord = fan_.rim[j] - pivot;
        const glm::dvec3 offset = fan_.apex - pivot;
        const double spokeSquare = glm::dot(spoke, spoke);
        const double chordSquare = glm::dot(chord, chord);
        const double both = glm::dot(spoke, chord);
        const double spokeOffset = glm::dot(spoke, offset);
        const double chordOffset = glm::dot(chord, offset);
        const double across = spokeSquare * chordSquare - both * both;
        double s = across > 0 ? (both * chordOffset - spokeOffset * chordSquare) / across : 0;
        s = std::clamp(s, minT, 1.0);
        double t = chordSquare > 0 ? (both * s + chordOffset) / chordSquare : 0;
        t = std::clamp(t, 0.0, maxT_[j]);
        minT = s;
        maxT_[j] = t;
        const glm::dvec3 way = offset + spoke * s - chord * t;
        const double square = glm::dot(way, way);
        square_[j] = std::max(square_[j], square);
        square_[j - 1] = std::max(square_[j - 1], square);
    }

    /// Computes the error of each triangle after the collapse: the max error of the old triangles that overlap it in
    /// the map, plus the displacement.
    void spread(const Row& before, Row& after) const {
        const std::uint32_t oldCount = fan_.isClosed ? fan_.count : fan_.count - 1;
        double sum = 0;
        for (std::uint32_t i = 0; i < oldCount; ++i)
            sum = std::max(sum, before[i]);
        after[host_] = sum;
        sum = before[0];
        for (std::uint32_t j = 1; j < host_; ++j)
            after[j] = sum = std::max(sum, before[j]);
        sum = fan_.isClosed ? before[fan_.count - 1] : 0;
        for (std::uint32_t j = fan_.count - 2; j > host_; --j)
            after[j] = sum = std::max(sum, before[j]);
        for (std::uint32_t j = 1; j + 1 < fan_.count; ++j)
            after[j] += std::sqrt(square_[j]);
    }

    const Fan& fan_;
    std::uint32_t host_ = 1;
    Row square_{}; // per new triangle: max squared displacement
    Row maxT_{};   // per new edge: max parameter (from rim 0) of the next crossing
};

} // namespace

FanAfter mapFan(const Fan& fan) {
    return FanMap(fan).after();
}

} // namespace gnomon::simplify
