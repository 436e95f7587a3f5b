#include "preprocess/make/bust_shape.h"

#include "preprocess/make/noise.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

namespace {

using glm::dvec3;

/// Returns the distance to the smooth union of two shapes. `a` and `b` are the distances to the shapes. The crease
/// between them is rounded over `k` metres.
double blend(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * k * 0.25;
}

/// Returns the distance to the first shape minus the second shape (smooth difference). `a` and `b` are the distances to
/// the shapes. The edge is rounded over `k` metres.
double carve(double a, double b, double k) {
    return -blend(-a, b, k);
}

double ellipsoid(const dvec3& p, const dvec3& center, const dvec3& radii) {
    const dvec3 q = p - center;
    const double k0 = glm::length(q / radii);
    const double k1 = glm::length(q / (radii * radii));
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

double capsule(const dvec3& p, const dvec3& a, const dvec3& b, double radiusA, double radiusB) {
    const dvec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::length(p - a - t * ab) - (radiusA + t * (radiusB - radiusA));
}

double roundedBox(const dvec3& p, const dvec3& center, const dvec3& half, double radius) {
    const dvec3 q = glm::abs(p - center) - half + radius;
    return glm::length(glm::max(q, dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0) - radius;
}

/// Returns 0 for `x` below `low`, 1 for `x` above `high`, and a smooth transition between them.
double ramp(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Returns the approximate angle of the direction (x, y) in turns, in [0, 1). The error is up to a hundredth of a turn.
/// The function replaces atan2, whose results differ between maths libraries.
double diamondTurns(double x, double y) {
    const double sum = std::abs(x) + std::abs(y);
    if (sum == 0) return 0;
    const double along = x / sum; // from 1 to -1 over half a turn
    return y >= 0 ? 0.25 * (1 - along) : 0.75 + 0.25 * along;
}

dvec3 mirrored(const dvec3& p) {
    return {std::abs(p.x), p.y, p.z};
}

} // namespace

BustShape::BustShape(std::uint64_t seed) : noiseSeed_(static_cast<std::uint32_t>(mix64(seed))) {
    Random random(mix64(seed ^ 0xB057U));
    shoulderWidth_ = random.uniform(0.165, 0.19);
    noseLength_ = random.uniform(0.0, 0.006);
    beardLength_ = random.uniform(0.0, 0.03);
    foldCount_ = std::floor(random.uniform(17, 23));
    foldTwist_ = random.uniform(0.5, 0.9);
}

double BustShape::strands(const dvec3& p) const {
    // The locks of hair follow a slow swirl, so that they are wavy. A second, finer set of locks divides them.
    const auto noise = [&](const dvec3& q, std::uint32_t salt) {
        return static_cast<double>(gradientNoise(
            static_cast<float>(q.x + 64),
            static_cast<float>(q.y + 64),
            static_cast<float>(q.z + 64),
            noiseSeed_ + salt));
    };
    const dvec3 swirl{noise(p * 14.0, 1), noise(p * 14.0, 2), noise(p * 14.0, 3)};
    const dvec3 q = p + 0.035 * swirl;
    const double locks = 1 - 2.2 * std::abs(noise({q.x * 44, q.y * 17, q.z * 44}, 4));
    const double fine = 1 - 2.2 * std::abs(noise({q.x * 95, q.y * 30, q.z * 95}, 5));
    return 0.0095 * locks + 0.0032 * fine;
}

double BustShape::folds(const dvec3& p) const {
    // The drapery hangs from a clasp on the left shoulder. Folds fan out from the clasp and bend as they fall.
    const dvec3 clasp{0.14, 0.435, 0.05};
    const dvec3 q = p - clasp;
    const double fall = glm::length(q);
    const double side = p.z >= -0.02 ? 0 : 0.37; // gives the back its own folds
    const double turns = diamondTurns(q.x, q.y) + side;
    const dvec3 at = p + dvec3(32.0 / 9.0);
    const auto wander = static_cast<double>(gradientNoise(
        static_cast<float>(at.x * 9), static_cast<float>(at.y * 9), static_cast<float>(at.z * 9), noiseSeed_ + 7));
    const double wave = 0.5 + 0.5 * sinTurns(turns * foldCount_ + foldTwist_ * fall * 2 + wander * 2.4);
    const double depth = 0.011 + 0.026 * std::abs(wander); // the folds differ in depth
    return (wave * wave * (3 - 2 * wave) - 0.35) * depth * std::min(1.0, fall * fall / (0.20 * 0.20));
}

double BustShape::faceDistance(const dvec3& p, double head) const {
    const dvec3 m = mirrored(p);
    double d = head;
    d = blend(d, capsule(m, {0, 0.657, 0.083}, {0.045, 0.655, 0.062}, 0.014, 0.012), 0.018);          // brow
    d = blend(d, ellipsoid(m, {0.043, 0.613, 0.060}, {0.024, 0.020, 0.022}), 0.025);                  // cheekbone
    d = carve(d, ellipsoid(m, {0.032, 0.636, 0.094}, {0.020, 0.0125, 0.019}), 0.014);                 // eye socket
    d = blend(d, ellipsoid(m, {0.0315, 0.6345, 0.0745}, {0.0155, 0.0115, 0.0135}), 0.003);            // eyeball
    d = blend(d, capsule(m, {0.018, 0.6435, 0.0865}, {0.046, 0.6415, 0.0755}, 0.0045, 0.004), 0.005); // upper lid
    const double tip = 0.119 + noseLength_;
    d = blend(d, capsule(p, {0, 0.650, 0.091}, {0, 0.603, tip - 0.004}, 0.0085, 0.0125), 0.012);  // nose
    d = blend(d, ellipsoid(m, {0.0125, 0.598, 0.103}, {0.0085, 0.0075, 0.011}), 0.006);           // nostril
    d = blend(d, capsule(m, {0, 0.5690, 0.1015}, {0.020, 0.5655, 0.090}, 0.0065, 0.0035), 0.006); // upper lip
    d = blend(d, capsule(m, {0, 0.5580, 0.1005}, {0.016, 0.5590, 0.092}, 0.0075, 0.0045), 0.005); // lower lip
    d = blend(d, ellipsoid(m, {0.079, 0.622, -0.004}, {0.010, 0.031, 0.019}), 0.006);             // ear
    return carve(d, ellipsoid(m, {0.092, 0.625, 0.004}, {0.008, 0.018, 0.010}), 0.006);
}

double BustShape::headDistance(const dvec3& p) const {
    const double around = glm::distance(p, dvec3(0, 0.60, 0.0)) - 0.20;
    if (around > 0.05) return around;
    const double locks = strands(p);
    double d = ellipsoid(p, {0, 0.665, -0.012}, {0.076, 0.098, 0.096});
    d = blend(d, ellipsoid(p, {0, 0.598, 0.030}, {0.059, 0.090, 0.068}), 0.05);
    d = faceDistance(p, d);
    // The hair is a cap over the skull that locks divide. The face remains free.
    double hair = ellipsoid(p, {0, 0.668, -0.022}, {0.087, 0.103, 0.103});
    hair = blend(hair, ellipsoid(p, {0, 0.585, -0.062}, {0.062, 0.075, 0.046}), 0.03);
    const double forehead = ellipsoid(p, {0, 0.618, 0.088}, {0.066, 0.085, 0.070});
    d = blend(d, carve(hair - locks, forehead, 0.012), 0.006);
    const dvec3 m = mirrored(p);
    double beard = ellipsoid(p, {0, 0.528 - 0.5 * beardLength_, 0.066}, {0.056, 0.062 + 0.5 * beardLength_, 0.043});
    beard = blend(beard, capsule(m, {0.062, 0.610, 0.022}, {0.042, 0.545, 0.055}, 0.013, 0.027), 0.02);
    beard = carve(beard, ellipsoid(p, {0, 0.5635, 0.112}, {0.024, 0.0105, 0.03}), 0.006); // the mouth remains visible
    d = blend(d, beard - 0.9 * locks, 0.006);
    const double moustache = capsule(m, {0.004, 0.5815, 0.106}, {0.040, 0.556, 0.086}, 0.0075, 0.006);
    return blend(d, moustache - 0.35 * locks, 0.004);
}

double BustShape::cloaked(const dvec3& p, double naked) const {
    if (naked > 0.1) return naked - 0.07; // at this distance the folds have no influence
    double d = naked;
    // The cloak covers everything except the right side of the chest.
    const double bare = ramp(-0.03, 0.03, 0.62 * p.x + 0.55 * (0.40 - p.y) + 0.075);
    const double drapery = folds(p);
    const double cloak = d - 0.010 - drapery;
    d = d + (std::min(d, cloak) - d) * bare;
    const double hem =
        capsule(p, {0.13, 0.45, 0.055}, {-0.10, 0.235, 0.128}, 0.024, 0.020); // the rolled edge across the chest
    d = blend(d, hem - 0.5 * drapery, 0.015);
    d = blend(d, ellipsoid(p, {0.135, 0.437, 0.062}, {0.024, 0.024, 0.020}), 0.004); // the clasp
    return d;
}

double BustShape::bodyDistance(const dvec3& p) const {
    const dvec3 m = mirrored(p);
    double d = ellipsoid(p, {0, 0.275, -0.005}, {0.205, 0.205, 0.125});
    d = blend(d, ellipsoid(m, {0.085, 0.315, 0.070}, {0.085, 0.060, 0.050}), 0.05); // chest
    d = blend(d, capsule(m, {0.05, 0.435, -0.02}, {shoulderWidth_, 0.375, -0.012}, 0.055, 0.078), 0.06);
    d = blend(d, capsule(m, {shoulderWidth_, 0.375, -0.012}, {shoulderWidth_ + 0.02, 0.27, 0.0}, 0.078, 0.062), 0.04);
    d = cloaked(p, d);
    // The lower end of the body is a curve that joins the plinth.
    d = blend(d, capsule(p, {0, 0.06, -0.01}, {0, 0.22, -0.01}, 0.080, 0.115), 0.06);
    const double stem = roundedBox(p, {0, 0.075, -0.01}, {0.125, 0.022, 0.105}, 0.010);
    const double base = roundedBox(p, {0, 0.030, -0.01}, {0.155, 0.030, 0.130}, 0.008);
    return blend(blend(d, stem, 0.012), base, 0.010);
}

double BustShape::distance(const dvec3& p) const {
    const double body = bodyDistance(p);
    const double neck = blend(
        capsule(p, {0, 0.40, -0.022}, {0, 0.56, -0.008}, 0.066, 0.056),
        capsule(mirrored(p), {0.016, 0.43, 0.045}, {0.052, 0.575, -0.015}, 0.012, 0.012),
        0.02);
    const double trunk = blend(body, neck, 0.045);
    if (p.y < 0.40) return trunk;
    return blend(trunk, headDistance(p), 0.022);
}

} // namespace gnomon::make
