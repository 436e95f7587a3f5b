#include "preprocess/make/statue_surface.h"

#include "preprocess/make/noise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::make {

namespace {

using glm::dvec3;

constexpr std::size_t kRows = 576;
constexpr std::size_t kColumns = 512; // a multiple of 4, so that each vertical edge of the grid's side is on a column

/// A ray from outside towards the axis of the statue. Its first hit is a point of the statue's surface.
struct Ray {
    dvec3 origin{0};
    dvec3 outward{0};
};

/// Returns the ray for the surface point at (s, around). `s` is from 0 to 1 on the base, from 1 to 2 on the side, and
/// from 2 to 3 on the crown. `around` is in quarter turns.
Ray rayAt(double s, double around) {
    constexpr double kBaseSlope = -0.36;
    constexpr double kCrownSlope = 0.62;
    constexpr double kLowest = 0.055;
    constexpr double kHighest = 0.655;
    const double turns = around * 0.25 + 0.125;
    const dvec3 ring{sinTurns(turns), 0, cosTurns(turns)};
    Ray ray;
    if (s < 1) {
        ray.origin = {0, kLowest, -0.01};
        ray.outward = ring * s + dvec3(0, -(1 - s * s) + kBaseSlope * s * s, 0);
    } else if (s <= 2) {
        const double t = s - 1;
        // The slope of the rays changes from the base to the crown. The rays are horizontal at the shoulders, where the
        // slope of the stone is between the slopes at both ends.
        const double slope = kBaseSlope + (kCrownSlope - kBaseSlope) * t;
        const double forward = -0.01 + 0.014 * t * t;
        ray.origin = {0, kLowest + (kHighest - kLowest) * t, forward};
        ray.outward = ring + dvec3(0, slope, 0);
    } else {
        const double m = 3 - s;
        ray.origin = {0, kHighest, 0.004};
        ray.outward = ring * m + dvec3(0, (1 - m * m) + kCrownSlope * m * m, 0);
    }
    ray.outward = glm::normalize(ray.outward);
    return ray;
}

dvec3 firstHit(const BustShape& shape, const Ray& ray) {
    constexpr int kSteps = 60;
    constexpr double kNear = 0.006; // nearer than this (metres), the secant method replaces the ray march
    double t = 0.34;
    double distance = shape.distance(ray.origin + t * ray.outward);
    double slope = 1;
    for (int step = 0; step < kSteps && std::abs(distance) > 5e-5 && t > 0.02; ++step) {
        const double move = std::abs(distance) < kNear ? std::clamp(distance / slope, -kNear, kNear) : 0.8 * distance;
        t -= move;
        const double before = distance;
        distance = shape.distance(ray.origin + t * ray.outward);
        slope = std::clamp((before - distance) / move, 0.5, 3.0);
    }
    return ray.origin + std::max(t, 0.02) * ray.outward;
}

/// Returns the four weights of a uniform cubic B-spline at the fraction `t` (0 to 1) of an interval.
std::array<float, 4> splineWeights(float t) {
    const float s = 1 - t;
    const float sixth = 1.0F / 6;
    return {s * s * s * sixth, (t * t * (3 * t - 6) + 4) * sixth, (s * s * (3 * s - 6) + 4) * sixth, t * t * t * sixth};
}

} // namespace

StatueSurface::StatueSurface(std::uint64_t seed) {
    const BustShape shape(seed);
    sampleMeridian(shape);
    castRays(shape);
    findOutward();
    measure();
}

const StatueSurface::Texel& StatueSurface::texel(std::size_t row, std::size_t column) const {
    return texels_[row * kColumns + column];
}

void StatueSurface::sampleMeridian(const BustShape& shape) {
    // The code averages the lengths of many meridians, so that the rows of the table are evenly spaced on the stone.
    constexpr std::size_t kSamples = 768;
    constexpr std::size_t kMeridians = 32;
    std::vector<std::array<dvec3, kMeridians>> points(kSamples + 1);
    tbb::parallel_for(std::size_t{0}, kSamples + 1, [&](std::size_t i) {
        const double s = 3.0 * static_cast<double>(i) / kSamples;
        for (std::size_t j = 0; j < kMeridians; ++j)
            points[i][j] = firstHit(shape, rayAt(s, 4.0 * static_cast<double>(j) / kMeridians));
    });
    std::vector<double> length(kSamples + 1, 0.0);
    for (std::size_t i = 1; i <= kSamples; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < kMeridians; ++j)
            // The upper limit excludes jumps between separate parts of the surface.
            sum += std::min(0.02, glm::distance(points[i][j], points[i - 1][j]));
        length[i] = length[i - 1] + sum / kMeridians;
    }
    meridian_ = length.back();
    baseEnd_ = static_cast<float>(length[kSamples / 3] / meridian_);
    crownBegin_ = static_cast<float>(length[2 * kSamples / 3] / meridian_);
    rayAlong_.resize(kRows);
    std::size_t i = 0;
    for (std::size_t row = 0; row < kRows; ++row) {
        const double target = meridian_ * static_cast<double>(row) / (kRows - 1);
        while (i + 1 < kSamples && length[i + 1] < target)
            ++i;
        const double fraction = std::clamp((target - length[i]) / (length[i + 1] - length[i]), 0.0, 1.0);
        rayAlong_[row] = 3.0 * (static_cast<double>(i) + fraction) / kSamples;
    }
}

void StatueSurface::castRays(const BustShape& shape) {
    texels_.resize(kRows * kColumns);
    tbb::parallel_for(std::size_t{0}, kRows, [&](std::size_t row) {
        for (std::size_t column = 0; column < kColumns; ++column) {
            const Ray ray = rayAt(rayAlong_[row], 4.0 * static_cast<double>(column) / kColumns);
            texels_[row * kColumns + column].position = glm::vec4(glm::vec3(firstHit(shape, ray)), 0);
        }
    });
}

void StatueSurface::findOutward() {
    // Each direction is computed from cross products over a few table entries, and then the directions are blurred.
    // They must be smooth, so that the displaced stone does not fold.
    constexpr std::size_t kReach = 3;
    std::vector<glm::vec3> raw(texels_.size());
    tbb::parallel_for(std::size_t{0}, kRows, [&](std::size_t row) {
        const std::size_t below = row < kReach ? 0 : row - kReach;
        const std::size_t above = std::min(row + kReach, kRows - 1);
        for (std::size_t column = 0; column < kColumns; ++column) {
            const std::size_t left = (column + kColumns - kReach) % kColumns;
            const std::size_t right = (column + kReach) % kColumns;
            const glm::vec3 around(texel(row, right).position - texel(row, left).position);
            const glm::vec3 up(texel(above, column).position - texel(below, column).position);
            const glm::vec3 normal = glm::cross(up, around);
            const float length = glm::length(normal);
            const float pole = row * 2 < kRows ? -1.0F : 1.0F;
            raw[row * kColumns + column] = length > 1e-9F ? -normal / length : glm::vec3(0, pole, 0);
        }
    });
    tbb::parallel_for(std::size_t{0}, kRows, [&](std::size_t row) {
        for (std::size_t column = 0; column < kColumns; ++column) {
            glm::vec3 sum(0);
            for (std::size_t i = 0; i < 5; ++i)
                for (std::size_t j = 0; j < 5; ++j) {
                    const std::size_t r = std::clamp<std::size_t>(row + i, 2, kRows + 1) - 2;
                    sum += raw[r * kColumns + (column + j + kColumns - 2) % kColumns];
                }
            texels_[row * kColumns + column].outward = glm::vec4(glm::normalize(sum), 0);
        }
    });
}

void StatueSurface::measure() {
    area_ = 0;
    for (std::size_t row = 0; row + 1 < kRows; ++row)
        for (std::size_t column = 0; column < kColumns; ++column) {
            const std::size_t next = (column + 1) % kColumns;
            const glm::vec3 a(texel(row, column).position);
            const glm::vec3 b(texel(row, next).position);
            const glm::vec3 c(texel(row + 1, column).position);
            const glm::vec3 d(texel(row + 1, next).position);
            area_ += 0.5 * static_cast<double>(glm::length(glm::cross(d - a, c - b)));
        }
}

SurfacePoint StatueSurface::at(float along, float around) const {
    const float y = std::clamp(along, 0.0F, 1.0F) * static_cast<float>(kRows - 1);
    const float x = around * (static_cast<float>(kColumns) / 4);
    const auto row = std::min(static_cast<std::size_t>(y), kRows - 2);
    const auto column = static_cast<std::size_t>(x);
    const std::array<float, 4> u = splineWeights(x - static_cast<float>(column));
    std::array<float, 4> v = splineWeights(y - static_cast<float>(row));
    glm::vec4 position(0);
    glm::vec4 outward(0);
    for (std::size_t i = 0; i < 4; ++i) {
        // Beyond a pole, the meridian continues on the opposite side of the statue, so that the spline is smooth at the
        // pole.
        const std::size_t r = row + i; // index of the row plus one
        const bool across = r == 0 || r > kRows;
        const std::size_t tableRow = r == 0 ? 1 : (r > kRows ? kRows - 2 : r - 1);
        const std::size_t shift = column + kColumns - 1 + (across ? kColumns / 2 : 0);
        for (std::size_t j = 0; j < 4; ++j) {
            const Texel& t = texel(tableRow, (shift + j) % kColumns);
            const float weight = u[j] * v[i];
            position += weight * t.position;
            outward += weight * t.outward;
        }
    }
    return {glm::vec3(position), glm::normalize(glm::vec3(outward))};
}

} // namespace gnomon::make
