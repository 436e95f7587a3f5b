#include "theory/scheme_table.h"

#include "shadow/scheme.h"
#include "shadow/stable_slice.h"
#include "shadow/view_fit.h"
#include "shadow/warp/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::theory {

namespace {

using namespace gnomon::shadow;

struct NamedScheme {
    const char* scheme;
    const char* warp;
    WarpRule rule;
    bool faces;
};

constexpr std::array<NamedScheme, 12> kSchemes{{
    {"ZP", "none", WarpRule::None, false},
    {"ZP+W", "psm", WarpRule::Psm, false},
    {"ZP+W", "lspsm", WarpRule::Lspsm, false},
    {"ZP+W", "minimax", WarpRule::Minimax, false},
    {"ZP+W", "auto", WarpRule::Auto, false},
    {"FP+ZP", "none", WarpRule::None, true},
    {"FP+ZP+W", "minimax", WarpRule::Minimax, true},
    {"FP+ZP+W", "auto", WarpRule::Auto, true},
    {"ZP", "log", WarpRule::Log, false},
    {"FP", "log", WarpRule::Log, true},
    {"ZP", "fitted", WarpRule::Fitted, false},
    {"FP", "fitted", WarpRule::Fitted, true},
}};

void add(SchemeRow& row, const Aliasing& unit, double sheared) {
    row.storageFactor += unit.x * unit.z;
    row.shearedStorageFactor += unit.x * sheared;
    row.worstX = std::max(row.worstX, unit.x);
    row.worstZ = std::max(row.worstZ, unit.z);
}

/// What a view that shows all of `map`'s region has of it. The needs of a row are largest at the ends of its section of
/// the region, which lie on lines between vertices.
SampleNeeds::Found ofWholeRegion(const SchemeMap& map) {
    constexpr int kSteps = 250;
    SampleNeeds needs(warpedMap(map.fit, map.kappa), map.fit.slice);
    const auto vertices = map.fit.points();
    const auto at = [&](const FitPoint& p) { return toCamera(map.fit.frame, {p.x, p.y, p.zeta + map.fit.zMin}); };
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
            for (int step = 0; step <= kSteps; ++step) {
                // Evenly in the logarithm of depth, as pixels see it.
                const double part = static_cast<double>(step) / kSteps;
                const double near = std::min(vertices[i].depth, vertices[j].depth);
                const double far = std::max(vertices[i].depth, vertices[j].depth);
                const double along = far > near ? (near * std::pow(far / near, part) - near) / (far - near) : part;
                const bool isTurned = vertices[i].depth > vertices[j].depth;
                needs.add(glm::mix(at(vertices[isTurned ? j : i]), at(vertices[isTurned ? i : j]), along));
            }
    return needs.under(needs.fit({map.unit.x, map.sheared}));
}

SchemeRow schemeRow(const ViewFrustum& frustum, const glm::dvec3& light, const NamedScheme& named, int slices) {
    Scheme scheme;
    scheme.warp.rule = named.rule;
    scheme.faces = named.faces;
    scheme.slices = slices;
    const std::vector<SchemeMap> maps = schemeMaps(frustum, light, scheme);
    SchemeRow row{named.scheme, named.warp, slices, maps.size()};
    for (const SchemeMap& map : maps) {
        if (named.rule != WarpRule::Fitted) {
            add(row, map.unit, map.sheared);
            continue;
        }
        const SampleNeeds::Found found = ofWholeRegion(map);
        add(row, {found.x.most, found.z}, found.sheared.most);
    }
    return row;
}

/// Slices that share the frame chosen about the light, and slices of the stable kind.
std::array<SchemeRow, 2> sliceRows(const ViewFrustum& frustum, const glm::dvec3& light, int slices) {
    const std::vector<double> splits = selfSimilarSplits(frustum.near, frustum.far, slices);
    const auto count = static_cast<std::size_t>(slices);
    std::array<SchemeRow, 2> rows{{{"ZP+W", "auto*", slices, count}, {"ZP stable", "none", slices, count}}};
    const LightFrame frame = chosenFrame(slice(frustum, splits[0], splits[1]), light, {}, std::nullopt);
    for (std::size_t i = 0; i < count; ++i) {
        const ViewFrustum part = slice(frustum, splits[i], splits[i + 1]);
        const LightFit fit = fitSlice(frame, part);
        const double kappa = kappaAuto(fit);
        add(rows[0], worstAliasing(fit, kappa), worstShearedAliasing(fit, kappa));
        const double stable = stableExtent(part) / imageBeamWidth(part, part.near, 1);
        add(rows[1], {stable, stable}, stable);
    }
    return rows;
}

} // namespace

std::vector<SchemeRow> schemeTable(const ViewFrustum& frustum, const glm::dvec3& towardsLight) {
    std::vector<SchemeRow> table;
    constexpr int kMostSlices = 8;
    for (const NamedScheme& named : kSchemes)
        for (int k = 1; k <= kMostSlices; ++k)
            table.push_back(schemeRow(frustum, towardsLight, named, k));
    for (const std::size_t kind : {std::size_t{0}, std::size_t{1}})
        for (int k = 1; k <= kMostSlices; ++k)
            table.push_back(sliceRows(frustum, towardsLight, k)[kind]);
    return table;
}

} // namespace gnomon::theory
