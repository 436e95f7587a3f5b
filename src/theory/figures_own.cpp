#include "shadow/scheme.h"
#include "shadow/stable_slice.h"
#include "shadow/warp/orientation.h"
#include "theory/figures.h"
#include "theory/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace gnomon::theory {

namespace {

using namespace gnomon::shadow;
using Kind = Figure::Kind;

const ViewFrustum kFrustum{1, 1000, 20 * kDegree, 1};

Scheme schemeOf(WarpRule rule, int slices) {
    Scheme scheme;
    scheme.warp.rule = rule;
    scheme.slices = slices;
    return scheme;
}

double storageAt(const glm::dvec3& light, const Scheme& scheme) {
    return storageFactor(schemeMaps(kFrustum, light, scheme));
}

/// Returns the storage factor S (texels per pixel) of self-similar slices in the orientation with the smallest S. All
/// slices have the same S, so only the first one is computed.
double storageChosen(const glm::dvec3& light, int slices) {
    const ViewFrustum first = slice(kFrustum, 1, selfSimilarSplits(1, 1000, slices)[1]);
    const LightFit fit = fitSlice(chosenFrame(first, light, {}, std::nullopt), first);
    return slices * storageFactor(fit, kappaAuto(fit));
}

Figure warpRules() {
    Figure figure{"own1_warp_rules", Kind::Maps, "Warp rules against no warp", {}, {}, {}};
    figure.caption =
        "log10 of S over that of no warp, one map, plain orientation; far/near 1000, theta 20 degrees. Above 0"
        " the warp does harm.";
    figure.panels = {"Wimmer 2004", "minimax", "auto"};
    figure.columns = {"panel", "light z", "light x", "log10 S / S_none"};
    double panel = 0;
    for (const WarpRule rule : {WarpRule::Lspsm, WarpRule::Minimax, WarpRule::Auto}) {
        for (const glm::dvec3& light : hemisphereGrid()) {
            const double ratio = storageAt(light, schemeOf(rule, 1)) / storageAt(light, schemeOf(WarpRule::None, 1));
            figure.rows.push_back({panel, light.z, light.x, std::log10(ratio)});
        }
        ++panel;
    }
    return figure;
}

Figure exactForms() {
    Figure figure{"own2_exact_eqs_20_and_21", Kind::Lines, "Eqs 20 and 21, printed and exact", {}, {}, {}};
    figure.caption =
        "Light behind, far/near 1000; the number of maps stands in the columns. The exact Eq 20 is least, 37.6, at"
        " k = 14 and then rises.";
    figure.xLabel = "z-partitions k";
    figure.yLabel = "storage factor S, or maps";
    figure.logY = true;
    figure.columns = {
        "k", "Eq 20 printed", "Eq 20 exact", "Eq 21 printed", "Eq 21 exact", "maps of Eq 20", "maps of Eq 21 exact"};
    for (int k = 1; k <= 24; ++k) {
        const ClosedForms forms = closedForms(kFrustum, k);
        const double count = k;
        figure.rows.push_back(
            {count, forms.zpBehindPaper, forms.zpBehind, forms.facesBehindPaper, forms.facesBehind, count, 5 * count});
    }
    return figure;
}

struct Spread {
    double worst = 0;
    double mean = 0;
};

template <class Storage>
Spread spreadOver(const std::vector<glm::dvec3>& lights, const Storage& storage) {
    Spread spread;
    for (const glm::dvec3& light : lights) {
        const double s = storage(light);
        spread.worst = std::max(spread.worst, s);
        spread.mean += s / static_cast<double>(lights.size());
    }
    return spread;
}

Figure storageToTwenty() {
    Figure figure{"own3_storage_to_20_slices", Kind::Lines, "Storage to twenty slices, over all lights", {}, {}, {}};
    figure.caption =
        "Worst and mean S over 1500 light directions; far/near 1000, theta 20 degrees. Past about twelve slices more"
        " maps are worse in the worst direction.";
    figure.xLabel = "z-partitions k";
    figure.yLabel = "storage factor S";
    figure.logY = true;
    figure.columns = {
        "k",
        "no warp worst",
        "no warp mean",
        "minimax worst",
        "minimax mean",
        "auto turned worst",
        "auto turned mean",
        "stable"};
    std::vector<glm::dvec3> lights = evenHemisphere(1500);
    lights.emplace_back(std::sqrt(0.5) * 1e-6, std::sqrt(0.5) * 1e-6, -1);
    for (int k = 1; k <= 20; ++k) {
        const Spread none =
            spreadOver(lights, [&](const glm::dvec3& l) { return storageAt(l, schemeOf(WarpRule::None, k)); });
        const Spread minimax =
            spreadOver(lights, [&](const glm::dvec3& l) { return storageAt(l, schemeOf(WarpRule::Minimax, k)); });
        const Spread chosen = spreadOver(lights, [&](const glm::dvec3& l) { return storageChosen(l, k); });
        const double m = stableExtent(slice(kFrustum, 1, selfSimilarSplits(1, 1000, k)[1])) / (2 * tanHalfY(kFrustum));
        figure.rows.push_back(
            {static_cast<double>(k),
             none.worst,
             none.mean,
             minimax.worst,
             minimax.mean,
             chosen.worst,
             chosen.mean,
             k * m * m});
    }
    return figure;
}

Figure effectOfLambda() {
    Figure figure{"own4_split_lambda", Kind::Lines, "What uneven splits cost", {}, {}, {}};
    figure.caption =
        "S of four slices against lambda of the practical split scheme, minimax warp; far/near 1000, theta 20"
        " degrees. 1 is self-similar.";
    figure.xLabel = "lambda";
    figure.yLabel = "storage factor S";
    figure.logY = true;
    figure.columns = {"lambda", "overhead", "behind", "45 degrees behind"};
    const glm::dvec3 tilted = glm::normalize(glm::dvec3(0, 1, -1));
    for (int i = 0; i <= 100; ++i) {
        Scheme scheme = schemeOf(WarpRule::Minimax, 4);
        scheme.splitLambda = i / 100.0;
        figure.rows.push_back(
            {scheme.splitLambda,
             storageAt({0, 1, 0}, scheme),
             storageAt({0, 0, -1}, scheme),
             storageAt(tilted, scheme)});
    }
    return figure;
}

Figure effectOfOrientation() {
    Figure figure{"own5_orientation", Kind::Maps, "What the turn about the light is worth", {}, {}, {}};
    figure.caption =
        "log10 S of four slices, auto warp, in the plain orientation, in the chosen one, and their ratio; far/near"
        " 1000, theta 20 degrees.";
    figure.panels = {"plain", "chosen", "chosen / plain"};
    figure.columns = {"panel", "light z", "light x", "log10 S"};
    for (const glm::dvec3& light : hemisphereGrid()) {
        const double plain = storageAt(light, schemeOf(WarpRule::Auto, 4));
        const double chosen = storageChosen(light, 4);
        figure.rows.push_back({0, light.z, light.x, std::log10(plain)});
        figure.rows.push_back({1, light.z, light.x, std::log10(chosen)});
        figure.rows.push_back({2, light.z, light.x, std::log10(chosen / plain)});
    }
    return figure;
}

/// Returns a figure that shows the largest storage factor S as a function of the angle between light and view. The
/// maximum is over all light directions with this angle.
Figure logarithmicMaps() {
    Figure figure{
        "own6_logarithmic", Kind::Lines, "Logarithmic maps against the warps, over the light's angle", {}, {}, {}};
    figure.caption =
        "Worst S of 90 lights at each angle to the view; far/near 1000, theta 20 degrees. Faces with logarithmic rows"
        " are the least that any maps can do.";
    figure.xLabel = "angle between light and view, degrees";
    figure.yLabel = "storage factor S";
    figure.logY = true;
    figure.columns = {
        "angle",
        "four warped slices",
        "sixteen",
        "faces and four slices",
        "one log map",
        "log faces",
        "log faces sheared"};
    Scheme logFaces = schemeOf(WarpRule::Log, 1);
    logFaces.faces = true;
    Scheme warpedFaces = schemeOf(WarpRule::Auto, 4);
    warpedFaces.faces = true;
    for (int degrees = 0; degrees <= 90; degrees += 2) {
        std::vector<double> worst(6, 0.0);
        for (int i = 0; i < 90; ++i) {
            const double across = std::sin(degrees * kDegree);
            const double turn = 4 * i * kDegree;
            const glm::dvec3 light(across * std::cos(turn), across * std::sin(turn), -std::cos(degrees * kDegree));
            const std::array<double, 6> found{
                storageAt(light, schemeOf(WarpRule::Auto, 4)),
                storageAt(light, schemeOf(WarpRule::Auto, 16)),
                storageAt(light, warpedFaces),
                storageAt(light, schemeOf(WarpRule::Log, 1)),
                storageAt(light, logFaces),
                shearedStorageFactor(schemeMaps(kFrustum, light, logFaces))};
            for (std::size_t k = 0; k < found.size(); ++k)
                worst[k] = std::max(worst[k], found[k]);
        }
        worst.insert(worst.begin(), degrees);
        figure.rows.push_back(std::move(worst));
    }
    return figure;
}

} // namespace

std::vector<glm::dvec3> hemisphereGrid() {
    constexpr int kHalf = 30;
    std::vector<glm::dvec3> lights;
    for (int i = -kHalf; i <= kHalf; ++i)
        for (int j = -kHalf; j <= kHalf; ++j) {
            const double x = static_cast<double>(i) / kHalf;
            const double z = static_cast<double>(j) / kHalf;
            const double rest = 1 - x * x - z * z;
            if (rest >= 0) lights.emplace_back(x, std::sqrt(rest), z);
        }
    return lights;
}

std::vector<glm::dvec3> evenHemisphere(int count) {
    constexpr double kGoldenAngle = 2.399963229728653;
    std::vector<glm::dvec3> lights;
    for (int i = 0; i < count; ++i) {
        const double y = (i + 0.5) / count;
        const double radius = std::sqrt(1 - y * y);
        lights.emplace_back(radius * std::cos(kGoldenAngle * i), y, radius * std::sin(kGoldenAngle * i));
    }
    return lights;
}

std::vector<Figure> ownFigures() {
    return {warpRules(), exactForms(), storageToTwenty(), effectOfLambda(), effectOfOrientation(), logarithmicMaps()};
}

std::string csvOf(const Figure& figure) {
    std::string text;
    const auto separate = [&](std::size_t column) { text += column > 0 ? "," : ""; };
    for (std::size_t i = 0; i < figure.columns.size(); ++i) {
        separate(i);
        text += figure.columns[i];
    }
    text += '\n';
    for (const std::vector<double>& row : figure.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::array<char, 32> number{};
            if (!std::isnan(row[i])) std::snprintf(number.data(), number.size(), "%.10g", row[i]);
            separate(i);
            text += number.data();
        }
        text += '\n';
    }
    return text;
}

} // namespace gnomon::theory
