#include "preprocess/levels/color_transfer.h"

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;
using Channels = std::array<float, 4>; // 0..255

/// What nobody sees in a shaded picture, of a channel: colours so near are taken for equal.
constexpr double kUnseenDifference = 0.03;

/// What a pixel may be wrong by, of a channel, before it counts as one whole pixel of error.
constexpr double kWrongPixel = 0.3;

Channels channelsOf(std::uint32_t color) {
    return {
        static_cast<float>(color & 0xFFU),
        static_cast<float>(color >> 8U & 0xFFU),
        static_cast<float>(color >> 16U & 0xFFU),
        static_cast<float>(color >> 24U)};
}

std::uint32_t packed(const Channels& channels) {
    std::uint32_t color = 0;
    for (std::size_t i = channels.size(); i-- > 0;)
        color = color << 8U | static_cast<std::uint32_t>(std::lround(std::clamp(channels[i], 0.0F, 255.0F)));
    return color;
}

using Corners = std::array<Channels, 3>;
using Weights = std::array<float, 3>;

Channels mixed(const Corners& colors, const Weights& weights) {
    Channels result{};
    for (std::size_t corner = 0; corner < colors.size(); ++corner)
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] += colors[corner][i] * weights[corner];
    return result;
}

double largestDifference(const Channels& a, const Channels& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return static_cast<double>(largest) / 255;
}

/// The weights of the corners of `t` at the point of it that is about nearest to `p`.
Weights weightsAt(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    std::array<double, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& a = t[(i + 1) % 3];
        weights[i] = std::max(glm::dot(glm::cross(t[(i + 2) % 3] - a, p - a), normal), 0.0);
    }
    const double sum = weights[0] + weights[1] + weights[2];
    constexpr float kThird = 1.0F / 3;
    if (!(sum > 0)) return {kThird, kThird, kThird};
    return {
        static_cast<float>(weights[0] / sum),
        static_cast<float>(weights[1] / sum),
        static_cast<float>(weights[2] / sum)};
}

/// Where a triangle is looked at: between its middle and each corner, so that what lies on a seam has one colour.
constexpr std::array<Weights, 3> kSampleWeights = {
    {{2.0F / 3, 1.0F / 6, 1.0F / 6}, {1.0F / 6, 2.0F / 3, 1.0F / 6}, {1.0F / 6, 1.0F / 6, 2.0F / 3}}};

std::vector<simplify::Triangle> cornersOf(
    const simplify::Patch& patch, const std::vector<simplify::Triangle>& triangles) {
    std::vector<simplify::Triangle> corners;
    corners.reserve(triangles.size());
    for (const simplify::Triangle& t : triangles)
        corners.push_back(patch.corners(t));
    return corners;
}

class ColorFit {
public:
    ColorFit(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified)
        : patch_(patch),
          simplified_(simplified),
          adjacency_(patch.positions.size(), cornersOf(patch, simplified.triangles)),
          reach_(patch.positions.size(), 0),
          residual_(patch.vertices.size()),
          weight_(patch.vertices.size(), 0),
          plainWeight_(patch.positions.size(), 0) {
        color_.reserve(patch.vertices.size());
        for (const hierarchy::Vertex& vertex : patch.vertices)
            color_.push_back(channelsOf(vertex.color));
        for (std::uint32_t p = 0; p < reach_.size(); ++p) {
            const std::uint32_t q = simplified.movedTo[p];
            const double moved = glm::length(patch.positions[p] - patch.positions[q]);
            reach_[q] = std::max(reach_[q], moved);
        }
    }

    ColorTransfer run() {
        for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t)
            compare(t);
        ColorTransfer result;
        for (std::uint32_t v = 0; v < color_.size(); ++v) {
            if (!(weight_[v] > 0) || patch_.isLocked[patch_.positionOf[v]] != 0) continue;
            for (std::size_t i = 0; i < color_[v].size(); ++i)
                color_[v][i] += residual_[v][i] / (weight_[v] + plainWeight_[patch_.positionOf[v]]);
            const std::uint32_t color = packed(color_[v]);
            color_[v] = channelsOf(color);
            if (color != patch_.vertices[v].color) result.colors.push_back({v, color});
        }
        for (const Sample& sample : samples_) {
            const double difference = largestDifference(sample.color, found(sample));
            result.error = std::max(result.error, colorCharge(sample.length, difference));
        }
        return result;
    }

private:
    /// A point of the patch, and where it lies on the simplified one.
    struct Sample {
        Channels color{};
        Weights weights{};
        std::uint32_t triangle = kNone;
        double length = 0;
    };

    std::array<glm::dvec3, 3> placesOf(const simplify::Triangle& t) const {
        const simplify::Triangle p = patch_.corners(t);
        return {patch_.positions[p[0]], patch_.positions[p[1]], patch_.positions[p[2]]};
    }

    Corners colorsOf(const simplify::Triangle& t) const { return {color_[t[0]], color_[t[1]], color_[t[2]]}; }

    Channels found(const Sample& sample) const {
        return mixed(colorsOf(simplified_.triangles[sample.triangle]), sample.weights);
    }

    /// The simplified triangles around what the corners of triangle `t` were collapsed into, each once; whether all of
    /// them have one colour, that of `t`, at all corners.
    bool gatherCandidates(const simplify::Triangle& t) {
        candidates_.clear();
        for (const std::uint32_t v : t)
            for (const std::uint32_t candidate : adjacency_.around(simplified_.movedTo[patch_.positionOf[v]]))
                candidates_.push_back(candidate);
        std::sort(candidates_.begin(), candidates_.end());
        candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
        const std::uint32_t color = patch_.vertices[t[0]].color;
        const auto isOfColor = [&](const simplify::Triangle& other) {
            return std::ranges::all_of(other, [&](std::uint32_t v) { return patch_.vertices[v].color == color; });
        };
        return isOfColor(t) && std::ranges::all_of(candidates_, [&](std::uint32_t candidate) {
                   return isOfColor(simplified_.triangles[candidate]);
               });
    }

    std::uint32_t nearestCandidate(const glm::dvec3& p) {
        std::uint32_t nearest = kNone;
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t first = 0; first < candidates_.size(); first += proximity::TriangleBatch::kCapacity) {
            const auto some = std::span(candidates_)
                                  .subspan(first)
                                  .first(std::min(proximity::TriangleBatch::kCapacity, candidates_.size() - first));
            batch_.clear();
            for (const std::uint32_t t : some) {
                const auto [a, b, c] = placesOf(simplified_.triangles[t]);
                batch_.add(a, b, c);
            }
            batch_.squaredDistances(p, squares_);
            for (std::size_t i = 0; i < some.size(); ++i) {
                if (squares_[i] >= best) continue;
                best = squares_[i];
                nearest = some[i];
            }
        }
        return nearest;
    }

    /// How far the corners of a triangle moved; where none did, how far what was collapsed into them did.
    double lengthOf(const simplify::Triangle& t) const {
        double moved = 0;
        double reach = 0;
        for (const std::uint32_t v : t) {
            const std::uint32_t p = patch_.positionOf[v];
            moved = std::max(moved, glm::length(patch_.positions[p] - patch_.positions[simplified_.movedTo[p]]));
            reach = std::max(reach, reach_[p]);
        }
        return moved > 0 ? moved : reach;
    }

    /// Looks at points of triangle `number` of the patch, and divides what is off there among the corners of the
    /// simplified triangle there.
    void compare(std::uint32_t number) {
        const simplify::Triangle& t = patch_.triangles[number];
        const bool isPlain = gatherCandidates(t);
        if (candidates_.empty()) return;
        const std::array<glm::dvec3, 3> places = placesOf(t);
        const Corners colors = colorsOf(t);
        const auto area = static_cast<float>(glm::length(glm::cross(places[1] - places[0], places[2] - places[0])));
        if (isPlain) { // nothing is off, but that counts
            for (const std::uint32_t v : t)
                plainWeight_[simplified_.movedTo[patch_.positionOf[v]]] += area;
            return;
        }
        const double length = lengthOf(t);
        for (const Weights& at : kSampleWeights) {
            const glm::dvec3 p = places[0] * static_cast<double>(at[0]) + places[1] * static_cast<double>(at[1]) +
                                 places[2] * static_cast<double>(at[2]);
            const std::uint32_t triangle = nearestCandidate(p);
            const simplify::Triangle& coarse = simplified_.triangles[triangle];
            Sample sample{mixed(colors, at), weightsAt(p, placesOf(coarse)), triangle, length};
            const Channels there = found(sample);
            for (std::size_t corner = 0; corner < coarse.size(); ++corner) {
                const float share = area * sample.weights[corner];
                weight_[coarse[corner]] += share;
                for (std::size_t i = 0; i < there.size(); ++i)
                    residual_[coarse[corner]][i] += share * (sample.color[i] - there[i]);
            }
            samples_.push_back(sample);
        }
    }

    const simplify::Patch& patch_;
    const simplify::SimplifiedPatch& simplified_;
    simplify::TriangleAdjacency adjacency_;
    std::vector<double> reach_;   // per position: how far what was collapsed into it moved
    std::vector<Channels> color_; // per vertex
    std::vector<Channels> residual_;
    std::vector<float> weight_;      // of what the residuals were added up over
    std::vector<float> plainWeight_; // per position: likewise, of triangles without any
    std::vector<Sample> samples_;
    std::vector<std::uint32_t> candidates_;
    proximity::TriangleBatch batch_;
    proximity::TriangleBatch::Row squares_{};
};

} // namespace

double colorCharge(double length, double difference) {
    return length * std::max(difference - kUnseenDifference, 0.0) / kWrongPixel;
}

ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    const bool isPlain = std::ranges::all_of(
        patch.vertices, [&](const hierarchy::Vertex& vertex) { return vertex.color == patch.vertices.front().color; });
    if (isPlain) return {};
    return ColorFit(patch, simplified).run();
}

} // namespace gnomon::levels
