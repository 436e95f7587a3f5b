#include "preprocess/simplify/fan_map.h"

#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::simplify {

namespace {

using Row = std::array<double, Fan::kMaxRim>;

/// The map of one fan. It computes the squared distance by which the cell corners in each new triangle move.
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
    /// Finds the new triangle that contains the image of the apex, and the distance of the apex from it.
    void placeApex() {
        const std::uint32_t end = fan_.count - 1;
        if (!fan_.isClosed) { // the open end must remain an open end
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

    /// Places the crossing of the old edge to rim `i` with the new edge to rim `j`. Its parameter on the old edge is at
    /// least `minT`.
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

    /// Sets the error of each new triangle to the max error of the overlapped old triangles plus its displacement.
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
    Row square_{}; // per new triangle
    Row maxT_{};   // per new edge: the max parameter of the next crossing, measured from rim 0
};

} // namespace

FanAfter mapFan(const Fan& fan) {
    return FanMap(fan).after();
}

} // namespace gnomon::simplify
