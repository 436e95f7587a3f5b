#include "shadow/scheme.h"
#include "shadow/warp/warped_map.h"
#include "theory/figures.h"
#include "theory/sampling.h"

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::theory {

namespace {

using namespace gnomon::shadow;
using Kind = Figure::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns where the image shows a ground point one unit below the eye. Returns NaN (a break in the curve) if it is
/// outside the image.
std::array<double, 2> groundInImage(const ViewFrustum& frustum, double x, double z) {
    constexpr double kHeight = 1;
    const double u = x / (z * tanHalfX(frustum));
    const double v = -kHeight / (z * tanHalfY(frustum));
    const bool visible = z >= frustum.near && std::abs(u) <= 1 && std::abs(v) <= 1;
    return visible ? std::array<double, 2>{u, v} : std::array<double, 2>{NAN, NAN};
}

void addTexelGrid(Figure& figure, double panel, const ViewFrustum& frustum, double nPrime) {
    const double kappa = 1 / nPrime;
    const double d = frustum.far - frustum.near;
    const WarpedMap map = warpedMap(fitSlice(lightFrame({0, 1, 0}), frustum), kappa);
    constexpr int kLines = 40;
    constexpr int kSteps = 400;
    double curve = 0;
    for (int axis = 0; axis < 2; ++axis)
        for (int line = 0; line <= kLines; ++line, ++curve)
            for (int step = 0; step <= kSteps; ++step) {
                const double along = std::pow(static_cast<double>(step) / kSteps, axis == 0 ? 3 : 1);
                const double across = static_cast<double>(line) / kLines;
                const double s = axis == 0 ? across : along;
                const double t = axis == 0 ? along : across;
                const double zeta = t * d / (1 + kappa * d * (1 - t));
                const double x = (map.uMin + s * map.width) * (1 + kappa * zeta);
                const std::array<double, 2> at = groundInImage(frustum, x, zeta + map.zMin);
                figure.rows.push_back({panel, curve, at[0], at[1]});
            }
}

Figure figure2() {
    const ViewFrustum frustum{0.5, 100, 30 * kDegree, 1};
    Figure figure{"figure02_texels_on_the_ground", Kind::Curves, "Shadow map texels on the ground", {}, {}, {}};
    figure.caption =
        "Every 1/40 of the map on a ground plane one unit below the eye; near 0.5, far 100, theta 30 degrees,"
        " light overhead. LSPSM looks worse than PSM through projection alone: both have the same S.";
    figure.panels = {"LSPSM, n' = n + sqrt(fn)", "PSM, n' = n"};
    figure.columns = {"panel", "curve", "x", "y"};
    addTexelGrid(figure, 0, frustum, nPrimeLspsm(frustum));
    addTexelGrid(figure, 1, frustum, frustum.near);
    return figure;
}

void addWarpPanels(Figure& figure, double panel, const ViewFrustum& frustum, double nPrime) {
    const double kappa = std::isinf(nPrime) ? 0 : 1 / nPrime;
    const WarpedMap map = warpedMap(fitSlice(lightFrame({0, 1, 0}), frustum), kappa);
    constexpr int kLines = 12;
    double curve = 0;
    for (int line = 0; line <= kLines; ++line) {
        const double part = static_cast<double>(line) / kLines;
        const double zeta = part * map.length / (1 + kappa * map.length * (1 - part));
        const double w = 1 + kappa * zeta;
        const double wFar = 1 + kappa * map.length;
        const double u = map.uMin + part * map.width;
        for (const double s : {0.0, 1.0})
            figure.rows.push_back({panel, curve, (map.uMin + s * map.width) * w, zeta + map.zMin});
        ++curve;
        figure.rows.push_back({panel, curve, u, map.zMin});
        figure.rows.push_back({panel, curve, u * wFar, map.zMin + map.length});
        ++curve;
        // The lower panels show how the grid of the view frustum appears in the shadow map.
        const double depth = frustum.near + part * (frustum.far - frustum.near);
        for (const double side : {-1.0, 1.0}) {
            const MapPoint at = mapPoint(map, {side * depth * tanHalfX(frustum), 0, depth});
            figure.rows.push_back({panel + 4, curve, at.s, at.t});
        }
        ++curve;
        for (int step = 0; step <= 20; ++step) {
            const double z = frustum.near + (frustum.far - frustum.near) * step / 20;
            const MapPoint at = mapPoint(map, {(2 * part - 1) * z * tanHalfX(frustum), 0, z});
            figure.rows.push_back({panel + 4, curve, at.s, at.t});
        }
        ++curve;
    }
}

Figure figure4() {
    const ViewFrustum frustum{1, 5, 30 * kDegree, 1};
    Figure figure{"figure04_warping", Kind::Curves, "Warping as n' falls from infinity to n", {}, {}, {}};
    figure.caption =
        "Above: the shadow map's grid in light space; below: a grid on the view frustum in the map. near 1,"
        " far 5, theta 30 degrees, light overhead.";
    figure.panels = {"n' = inf", "2 n'_LSPSM", "n'_LSPSM", "n' = n", "the same, in the map", "", "", ""};
    figure.columns = {"panel", "curve", "x", "y"};
    const double lspsm = nPrimeLspsm(frustum);
    double panel = 0;
    for (const double nPrime : {kInfinity, 2 * lspsm, lspsm, frustum.near})
        addWarpPanels(figure, panel++, frustum, nPrime);
    return figure;
}

Figure figure5() {
    const ViewFrustum frustum{1, 20, 30 * kDegree, 1};
    const double lspsm = nPrimeLspsm(frustum);
    const std::array<double, 4> nPrimes{kInfinity, 4 * lspsm, lspsm, frustum.near};
    Figure figure{"figure05_error_along_the_frustum", Kind::Lines, "Aliasing along the frustum", {}, {}, {}};
    figure.caption = "m_x (Eq 7) and m_z (Eq 8) at unit resolutions; near 1, far 20, theta 30 degrees, light overhead.";
    figure.xLabel = "view depth z";
    figure.yLabel = "perspective aliasing";
    figure.logY = true;
    figure.columns = {
        "z", "m_x inf", "m_x 4 LSPSM", "m_x LSPSM", "m_x n", "m_z inf", "m_z 4 LSPSM", "m_z LSPSM", "m_z n"};
    for (int i = 0; i <= 200; ++i) {
        const double z = frustum.near + (frustum.far - frustum.near) * i / 200;
        std::vector<double> row(9, z);
        for (std::size_t j = 0; j < nPrimes.size(); ++j) {
            const Aliasing m = aliasingOverhead(frustum, nPrimes[j], z, {});
            row[1 + j] = m.x;
            row[5 + j] = m.z;
        }
        figure.rows.push_back(row);
    }
    return figure;
}

Figure figure6() {
    const ViewFrustum frustum{1, 100, 30 * kDegree, 1};
    Figure figure{"figure06_varying_n_prime", Kind::Lines, "Largest error and storage against eta", {}, {}, {}};
    figure.caption =
        "M_x, M_z and S, each over its largest value; n' goes from infinity (eta -1) over n'_LSPSM (0) to n (1)."
        " near 1, far 100, theta 30 degrees, light overhead.";
    figure.xLabel = "eta";
    figure.yLabel = "share of the largest value";
    figure.columns = {"eta", "M_x", "M_z", "S"};
    const Aliasing unwarped = worstAliasingOverhead(frustum, kInfinity);
    for (int i = 0; i <= 200; ++i) {
        const double eta = -1 + i / 100.0;
        const double nPrime = nPrimeOfEta(frustum, eta);
        const Aliasing worst = worstAliasingOverhead(frustum, nPrime);
        figure.rows.push_back(
            {eta,
             worst.x / unwarped.x,
             worst.z / unwarped.z,
             storageFactorOverhead(frustum, nPrime) / (unwarped.x * unwarped.z)});
    }
    return figure;
}

Figure figure7() {
    const ViewFrustum frustum{1, 100, 30 * kDegree, 1};
    Figure figure{
        "figure07_storage_over_light_directions", Kind::Maps, "Storage factor over light directions", {}, {}, {}};
    figure.caption =
        "log10 S of one map, one warped map (minimax), and warped face partitions (normalised bisector, near square"
        " included); near 1, far 100, theta 30 degrees. Overhead in the middle, behind on the left.";
    figure.panels = {"no warp", "warp", "face partitions and warp"};
    figure.columns = {"panel", "light z", "light x", "log10 S"};
    Scheme unwarped;
    unwarped.warp.rule = WarpRule::None;
    unwarped.slices = 1;
    Scheme warped = unwarped;
    warped.warp.rule = WarpRule::Minimax;
    Scheme faces = warped;
    faces.faces = true;
    double panel = 0;
    for (const Scheme& scheme : {unwarped, warped, faces}) {
        for (const glm::dvec3& light : hemisphereGrid())
            figure.rows.push_back(
                {panel, light.z, light.x, std::log10(storageFactor(schemeMaps(frustum, light, scheme)))});
        ++panel;
    }
    return figure;
}

Figure figure10() {
    const ViewFrustum frustum{1, 1000, 20 * kDegree, 1};
    Figure figure{"figure10_storage_overhead", Kind::Lines, "Storage against z-partitions, light overhead", {}, {}, {}};
    figure.caption = "Eqs 17 and 18 and the logarithmic optimum of appendix C; far/near 1000, theta 20 degrees.";
    figure.xLabel = "z-partitions k";
    figure.yLabel = "storage factor S";
    figure.logY = true;
    figure.columns = {"k", "ZP", "ZP+W", "optimum"};
    for (int k = 1; k <= 20; ++k) {
        const ClosedForms forms = closedForms(frustum, k);
        figure.rows.push_back({static_cast<double>(k), forms.zpOverhead, forms.zpWarpOverhead, forms.optimal});
    }
    return figure;
}

Figure figure12() {
    const ViewFrustum frustum{1, 1000, 20 * kDegree, 1};
    Figure figure{"figure12_storage_against_maps", Kind::Lines, "Storage against the number of maps", {}, {}, {}};
    figure.caption =
        "far/near 1000, theta 20 degrees. Eqs 17, 18, 20 and 21 as printed, and 20 and 21 exactly: the printed Eq"
        " 20 drops a strip, Eq 21 the near square, which costs a fifth map a slice.";
    figure.xLabel = "number of shadow maps";
    figure.yLabel = "storage factor S";
    figure.logY = true;
    figure.columns = {
        "maps",
        "ZP overhead",
        "ZP+W overhead",
        "ZP behind (Eq 20)",
        "ZP behind exact",
        "FP+ZP+W behind (Eq 21)",
        "FP+ZP+W behind exact"};
    for (int maps = 1; maps <= 40; ++maps) {
        const ClosedForms forms = closedForms(frustum, maps);
        const double four = maps % 4 == 0 ? closedForms(frustum, maps / 4).facesBehindPaper : NAN;
        const double five = maps % 5 == 0 ? closedForms(frustum, maps / 5).facesBehind : NAN;
        figure.rows.push_back(
            {static_cast<double>(maps),
             forms.zpOverhead,
             forms.zpWarpOverhead,
             forms.zpBehindPaper,
             forms.zpBehind,
             four,
             five});
    }
    return figure;
}

} // namespace

std::vector<Figure> paperFigures() {
    return {figure2(), figure4(), figure5(), figure6(), figure7(), figure10(), figure12()};
}

} // namespace gnomon::theory
