#include "plan/light_directions.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace gnomon::plan {

namespace {

using UnitTurn = std::complex<double>;

/// Returns the rotation by `times` golden angles, as a unit complex number. A golden angle is pi (3 - sqrt 5). The
/// function uses only products, so the result does not depend on the cosine of a math library.
UnitTurn goldenTurn(int times) {
    UnitTurn power(-0.7373688780783197, 0.6754902942615238);
    UnitTurn turn(1, 0);
    for (auto bits = static_cast<unsigned>(times); bits != 0; bits >>= 1U) {
        if ((bits & 1U) != 0) turn *= power;
        power *= power;
    }
    return turn;
}

/// Returns the new position of item `i` if a list of `count` items is reordered such that consecutive items are about
/// 0.618 of the list apart (golden section). Item 0 stays first.
int spreadPlace(int i, int count) {
    constexpr double kGolden = 0.61803398874989485;
    auto stride = std::max(static_cast<std::int64_t>(std::llround(kGolden * count)), std::int64_t{1});
    while (std::gcd(stride, std::int64_t{count}) != 1)
        ++stride;
    return static_cast<int>(i * stride % count);
}

struct AxesAcross {
    glm::dvec3 right, up;
};

/// Returns two unit vectors that are perpendicular to each other and to `axis` (unit length).
AxesAcross axesAcross(const glm::dvec3& axis) {
    glm::dvec3 other(0);
    other[std::abs(axis.x) < 0.5 ? 0 : 1] = 1;
    const glm::dvec3 right = glm::normalize(glm::cross(other, axis));
    return {right, glm::cross(axis, right)};
}

} // namespace

const std::array<DiscSampling, 23> kDiscSamplings = {{
    {4, 0.3569, 4},    {8, 0.2501, 7},    {12, 0.1706, 9},    {16, 0.1502, 7},   {24, 0.1091, 6},    {32, 0.0827, 8},
    {48, 0.0647, 4},   {64, 0.0543, 38},  {80, 0.0447, 53},   {96, 0.0379, 7},   {128, 0.0362, 5},   {160, 0.0283, 5},
    {192, 0.0257, 7},  {256, 0.0224, 7},  {320, 0.0177, 7},   {384, 0.0162, 6},  {512, 0.0133, 5},   {768, 0.0100, 4},
    {1024, 0.0078, 4}, {1536, 0.0062, 9}, {2048, 0.0048, 10}, {3072, 0.0032, 7}, {4096, 0.0027, 16},
}};

int directionsFor(double lightError) {
    constexpr double kOfDisc = 0.85;
    for (const DiscSampling& sampling : kDiscSamplings)
        if (sampling.error <= kOfDisc * lightError) return sampling.directions;
    return kDiscSamplings.back().directions;
}

int minFirstPoints(int directions) {
    for (const DiscSampling& sampling : kDiscSamplings)
        if (sampling.directions == directions) return sampling.first;
    return directions;
}

double minPenumbra(double lightError) {
    constexpr double kPi = 3.14159265358979323846;
    return lightError * 3 * kPi;
}

glm::dvec2 discPoint(int i, int count) {
    if (count == 1) return glm::dvec2(0);
    const int place = spreadPlace(i, count);
    const double radius = std::sqrt(place / (count - 0.5));
    const UnitTurn turn = goldenTurn(place);
    return {radius * turn.real(), radius * turn.imag()};
}

glm::dvec3 towardsDisc(const glm::dvec3& middle, double angleRadians, const glm::dvec2& point) {
    const glm::dvec3 axis = glm::normalize(middle);
    const auto [right, up] = axesAcross(axis);
    const double radius = std::tan(angleRadians / 2);
    return glm::normalize(axis + radius * (point.x * right + point.y * up));
}

SkyPart skyPart(int i, int count, SkyModel model, const glm::dvec3& up) {
    const int place = spreadPlace(i, count);
    const double height = 1 - (place + 0.5) / count;
    const double level = std::sqrt(1 - height * height);
    const UnitTurn turn = goldenTurn(place);
    const glm::dvec3 axis = glm::normalize(up);
    const auto [right, other] = axesAcross(axis);
    SkyPart part;
    part.direction = height * axis + level * (turn.real() * right + turn.imag() * other);
    if (model == SkyModel::Overcast) part.weight = 2 * (3 + 6 * height) / 7;
    return part;
}

double levelSkyLight(int count, SkyModel model) {
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const SkyPart part = skyPart(i, count, model, {0, 0, 1});
        sum += part.weight * part.direction.z;
    }
    return sum / count;
}

double skyError(int parts, SkyModel model) {
    const double brightest = model == SkyModel::Overcast ? 9.0 / 7 : 1;
    return 1.4 * brightest * std::pow(parts, -0.75);
}

} // namespace gnomon::plan
