#include "tests/theory/closed_forms.h"

#include "shadow/depth_bias.h"
#include "shadow/scheme.h"
#include "shadow/stable_slice.h"
#include "shadow/warp/warped_map.h"
#include "tests/support/log_forms.h"
#include "tests/support/random_views.h"
#include "tests/theory/exact_theory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace gnomon::theory {
namespace {

double anyOf(Random& random, std::initializer_list<double> values) {
    return *(values.begin() + random.below(values.size()));
}

/// Near, far, theta and aspect: depth ratios from 1 + 1e-6 to 1e8 and half angles from 0.005 to 89 degrees.
Doubles drawView(Random& random) {
    const double near = random.below(8) == 0 ? anyOf(random, {1e-3, 1, 1024}) : std::pow(10, random.uniform(-3, 3));
    const double more = random.below(8) == 0 ? anyOf(random, {1e-6, 1, 3, 1e8}) : std::pow(10, random.uniform(-6, 8));
    double theta = random.uniform(5, 70);
    if (random.below(3) == 0) theta = std::pow(10, random.uniform(std::log10(0.005), std::log10(89)));
    if (random.below(10) == 0) theta = anyOf(random, {0.005, 45, 89});
    return {near, near + near * more, theta * kPi / 180, anyOf(random, {1, 1, 0.5, 16.0 / 9, 3, 10, 0.1})};
}

shadow::ViewFrustum frustumOf(const Doubles& in) {
    return {in[0], in[1], in[2], in[3]};
}

exact::Frustum frustumOf(const Reals& in) {
    return {in[0], in[1], in[2], in[3]};
}

Doubles with(Doubles inputs, std::initializer_list<double> more) {
    inputs.insert(inputs.end(), more);
    return inputs;
}

/// A view and n' from near to infinity, on both sides of n'_LSPSM and at it.
Doubles drawWarped(Random& random) {
    Doubles in = drawView(random);
    const double min = shadow::nPrimeLspsm(frustumOf(in));
    const double n = in[0];
    const double inside = std::min(min, n + (min - n) * random.unit());
    const std::array<double, 5> choices{n, inside, min, min * std::pow(10, random.uniform(0, 9)), INFINITY};
    in.push_back(choices[random.below(choices.size())]);
    return in;
}

Doubles drawDepth(Random& random) {
    Doubles in = drawWarped(random);
    in.push_back(random.below(4) == 0 ? anyOf(random, {in[0], in[1]}) : in[0] + (in[1] - in[0]) * random.unit());
    return in;
}

Doubles drawEta(Random& random) {
    const double eta = random.below(2) == 0 ? anyOf(random, {-1, -1 + 0x1p-53, -1 + 1e-9, -0.5, -1e-9, 0, 1e-9, 1})
                                            : random.uniform(-1, 1);
    return with(drawView(random), {eta});
}

Doubles drawFocus(Random& random) {
    Doubles in = drawView(random);
    return with(in, {(in[1] - in[0]) * std::pow(10, random.uniform(-6, 0)), anyOf(random, {0.8, 0.5, 0.95})});
}

Doubles drawSplit(Random& random) {
    const auto count = 1 + random.below(64);
    const auto index = random.below(count + 1);
    const double lambda = random.below(2) == 0 ? anyOf(random, {0, 1}) : random.unit();
    return with(drawView(random), {lambda, static_cast<double>(count), static_cast<double>(index)});
}

/// Any light but those at a sine of 1e-12 to the view, where the plain convention itself jumps.
Doubles drawLit(Random& random) {
    glm::dvec3 light = shadow::randomLight(random);
    while (std::abs(shadow::sinLightAngle(light) * 1e12 - 1) < 0.01)
        light = shadow::randomLight(random);
    return with(drawView(random), {light.x, light.y, light.z});
}

/// A view, a light, a kappa and whether the rows are logarithmic.
Doubles drawMap(Random& random) {
    Doubles in = drawLit(random);
    const double kappa = random.below(4) == 0 ? 0 : std::pow(10, random.uniform(-6, 1)) / in[0];
    return with(in, {kappa, anyOf(random, {0, 1})});
}

shadow::LightFit fitOf(const Doubles& in) {
    shadow::LightFit fit = shadow::fitSlice(shadow::lightFrame({in[4], in[5], in[6]}), frustumOf(in));
    if (in.size() > 8 && in[8] != 0) fit.rows = shadow::RowSpacing::Logarithmic;
    return fit;
}

exact::Fit fitOf(const Reals& in) {
    exact::Fit fit = exact::fitSlice(frustumOf(in), {in[4], in[5], in[6]});
    fit.hasLogRows = in.size() > 8 && !(in[8] == 0);
    return fit;
}

int whole(const Real& a) {
    return static_cast<int>(a.rounded());
}

// The forms of one map with the light straight overhead.

Doubles oursOverhead(const Doubles& in) {
    const shadow::ViewFrustum v = frustumOf(in);
    const shadow::Aliasing worst = shadow::worstAliasingOverhead(v, in[4]);
    return {shadow::nPrimeLspsm(v), worst.x, worst.z, shadow::storageFactorOverhead(v, in[4])};
}

Reals exactOverhead(const Reals& in) {
    const exact::Frustum v = frustumOf(in);
    const exact::Pair worst = exact::worstOverhead(v, in[4]);
    return {exact::nPrimeLspsm(v), worst.x, worst.z, exact::storageOverhead(v, in[4])};
}

Doubles drawBeforeNear(Random& random) {
    Doubles in = drawView(random);
    return with(in, {in[0] * std::pow(10, random.uniform(-3, 0))});
}

Doubles oursPoint(const Doubles& in) {
    const shadow::Aliasing m = shadow::aliasingOverhead(frustumOf(in), in[4], in[5], {});
    return {m.x, m.z, shadow::imageBeamWidth(frustumOf(in), in[5], 800)};
}

Reals exactPoint(const Reals& in) {
    const exact::Pair m = exact::aliasingOverhead(frustumOf(in), in[4], in[5]);
    return {m.x, m.z, exact::imageBeamWidth(frustumOf(in), in[5], 800)};
}

Doubles oursClosed(const Doubles& in) {
    const shadow::ClosedForms forms = shadow::closedForms(frustumOf(in), static_cast<int>(in[5]));
    return {
        forms.zpOverhead,
        forms.zpWarpOverhead,
        forms.zpBehindPaper,
        forms.zpBehind,
        forms.facesBehindPaper,
        forms.facesBehind,
        forms.optimal};
}

Reals exactClosed(const Reals& in) {
    const auto forms = exact::closedForms(frustumOf(in), whole(in[5]));
    return {forms.begin(), forms.end()};
}

Doubles oursLarge(const Doubles& in) {
    const auto forms = shadow::largeRatioForms(in[1] / in[0], static_cast<int>(in[5]));
    return {forms.zpOverhead, forms.facesBehind};
}

Reals exactLarge(const Reals& in) {
    return {power(in[1] / in[0], 2 / in[5]), power(in[1] / in[0], 4 / in[5])};
}

// Those of any light.

Doubles oursMeasures(const Doubles& in) {
    const shadow::LightFit fit = fitOf(in);
    const shadow::Aliasing worst = shadow::worstAliasing(fit, in[7]);
    return {
        fit.length,
        shadow::warpedExtent(fit, in[7]).width(),
        worst.x,
        worst.z,
        shadow::storageFactor(fit, in[7]),
        shadow::worstShearedAliasing(fit, in[7]),
        shadow::largestRawBias(fit, in[7], {1, 1024, 1024}, 3)};
}

Reals exactMeasures(const Reals& in) {
    const exact::Fit fit = fitOf(in);
    const exact::Measures found = exact::measures(fit, in[7]);
    const Real bias = exact::largestRawBias(fit, in[7], 1024, 3);
    return {fit.d, found.width, found.mx, found.mz, found.mx * found.mz, found.sheared, bias};
}

/// The reach of the near and of the far vertices, d, and a depth ratio.
Doubles drawReaches(Random& random) {
    const Doubles in = drawLit(random);
    const shadow::LightFit fit = fitOf(in);
    double near = 0;
    double far = 0;
    for (const shadow::FitPoint& point : fit.points()) {
        double& end = point.end == shadow::DepthEnd::Near ? near : far;
        end = std::max(end, point.zeta);
    }
    return {near, far, std::max(near, far), in[1] / in[0]};
}

Doubles oursMinimax(const Doubles& in) {
    shadow::LightFit fit;
    fit.slice = {1, in[3], 0.5, 1};
    fit.length = in[2];
    fit.count = 2;
    fit.storage[0] = {0, 0, in[0], 1, shadow::DepthEnd::Near};
    fit.storage[1] = {0, 0, in[1], in[3], shadow::DepthEnd::Far};
    return {shadow::kappaMinimax(fit)};
}

/// A map of a fit, field by field, and a point of the view.
Doubles drawMapped(Random& random) {
    const Doubles in = drawMap(random);
    const shadow::WarpedMap map = shadow::warpedMap(fitOf(in), in[7]);
    const glm::dvec3 p = shadow::randomPointIn(random, frustumOf(in));
    const shadow::LightFrame& f = map.frame;
    return {f.x.x,    f.x.y,      f.x.z,    f.y.x,     f.y.y,      f.y.z,        f.z.x, f.z.y, f.z.z, map.kappa,
            map.zMin, map.length, map.uMin, map.width, map.rawMin, map.rawRange, p.x,   p.y,   p.z,   in[8]};
}

Doubles oursMapped(const Doubles& in) {
    shadow::WarpedMap map;
    map.frame = {{in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7], in[8]}};
    map.kappa = in[9];
    map.zMin = in[10];
    map.length = in[11];
    map.uMin = in[12];
    map.width = in[13];
    map.rawMin = in[14];
    map.rawRange = in[15];
    if (in[19] != 0 && map.kappa > 0) map.rows = shadow::RowSpacing::Logarithmic;
    const glm::dvec3 p{in[16], in[17], in[18]};
    const shadow::MapPoint at = shadow::mapPoint(map, p);
    const shadow::LightBeam beam = shadow::lightBeam(map, p, {});
    return {at.s, at.t, at.depth, beam.x, beam.z, beam.sheared};
}

Reals exactMapped(const Reals& in) {
    exact::Map map{
        {{in[0], in[1], in[2]}, {in[3], in[4], in[5]}, {in[6], in[7], in[8]}},
        in[9],
        in[10],
        in[11],
        in[12],
        in[13],
        in[14],
        in[15]};
    map.hasLogRows = !(in[19] == 0) && in[9] > 0;
    const auto found = exact::pointOf(map, {in[16], in[17], in[18]});
    return {found.begin(), found.end()};
}

const std::vector<ClosedForm> kForms = {
    {"one map overhead", {"n'_LSPSM", "M_x", "M_z", "S"}, drawWarped, oursOverhead, exactOverhead},
    {"S overhead, n' < n",
     {"S"},
     drawBeforeNear,
     [](const Doubles& in) { return Doubles{shadow::storageFactorOverhead(frustumOf(in), in[4])}; },
     [](const Reals& in) { return Reals{exact::storageOverhead(frustumOf(in), in[4])}; }},
    {"point overhead", {"m_x", "m_z", "w_i"}, drawDepth, oursPoint, exactPoint},
    {"n' of eta",
     {"n'"},
     drawEta,
     [](const Doubles& in) { return Doubles{shadow::nPrimeOfEta(frustumOf(in), in[4])}; },
     [](const Reals& in) { return Reals{exact::nPrimeOfEta(frustumOf(in), in[4])}; }},
    {"eta of n'",
     {"eta"},
     drawWarped,
     [](const Doubles& in) { return Doubles{shadow::etaOfNPrime(frustumOf(in), in[4])}; },
     [](const Reals& in) { return Reals{exact::etaOfNPrime(frustumOf(in), in[4])}; }},
    {"n' of a TSM",
     {"n'"},
     drawFocus,
     [](const Doubles& in) { return Doubles{shadow::nPrimeTsm(frustumOf(in), in[4], in[5])}; },
     [](const Reals& in) { return Reals{exact::nPrimeTsm(frustumOf(in), in[4], in[5])}; }},
    {"slices",
     {"q - 1", "split"},
     drawSplit,
     [](const Doubles& in) {
         const auto count = static_cast<int>(in[5]);
         const Doubles splits = shadow::practicalSplits(in[0], in[1], count, in[4]);
         return Doubles{shadow::sliceRatioMinusOne(in[0], in[1], count), splits[static_cast<std::size_t>(in[6])]};
     },
     [](const Reals& in) {
         return Reals{
             exact::sliceRatio(in[0], in[1], whole(in[5])) - 1,
             exact::split(in[0], in[1], whole(in[5]), whole(in[6]), in[4])};
     },
     5},
    {"schemes",
     {"Eq 17", "Eq 18", "Eq 20", "k q^2", "Eq 21", "2k(q - 1) + k", "optimum"},
     drawSplit,
     oursClosed,
     exactClosed,
     5},
    {"large ratios", {"Eq 22", "Eq 23"}, drawSplit, oursLarge, exactLarge, 5},
    {"stable extent",
     {"extent"},
     drawView,
     [](const Doubles& in) { return Doubles{shadow::stableExtent(frustumOf(in))}; },
     [](const Reals& in) { return Reals{exact::stableExtent(frustumOf(in))}; }},
    {"logarithmic sums",
     {"S", "S_t"},
     drawLit,
     [](const Doubles& in) {
         const glm::dvec3 light{in[4], in[5], in[6]};
         return Doubles{
             shadow::logStorageFactor(frustumOf(in), light), shadow::logShearedStorageFactor(frustumOf(in), light)};
     },
     [](const Reals& in) {
         const exact::Vector light{in[4], in[5], in[6]};
         return Reals{exact::logStorage(frustumOf(in), light), exact::logShearedStorage(frustumOf(in), light)};
     }},
    {"any light", {"d", "W", "M_x", "M_z", "S", "M_t", "bias"}, drawMap, oursMeasures, exactMeasures},
    {"kappa",
     {"sin gamma", "lspsm", "1 + kappa d, minimax"},
     drawLit,
     [](const Doubles& in) {
         const shadow::LightFit fit = fitOf(in);
         const double growth = 1 + shadow::kappaMinimax(fit) * fit.length;
         return Doubles{shadow::sinLightAngle(fit.frame.y), shadow::kappaLspsm(fit), growth};
     },
     [](const Reals& in) {
         const exact::Fit fit = fitOf(in);
         const Real growth = 1 + exact::kappaMinimax(fit) * fit.d;
         return Reals{exact::sinLightAngle(fit.frame.y), exact::kappaLspsm(fit), growth};
     }},
    {"kappa of a fit",
     {"minimax"},
     drawReaches,
     oursMinimax,
     [](const Reals& in) { return Reals{exact::kappaMinimax(in[0], in[1], in[2], in[3])}; }},
    {"point of a map", {"s", "t", "depth", "w_lx", "w_lz", "sheared w_lz"}, drawMapped, oursMapped, exactMapped},
};

} // namespace

const std::vector<ClosedForm>& closedFormsWithTwins() {
    return kForms;
}

} // namespace gnomon::theory
