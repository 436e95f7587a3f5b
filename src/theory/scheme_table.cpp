#include "theory/scheme_table.h"

#include "shadow/scheme.h"
#include "shadow/stable_slice.h"
#include "shadow/warp/orientation.h"

#include <algorithm>
#include <array>

namespace gnomon::theory {

namespace {

using namespace gnomon::shadow;

struct NamedScheme {
    const char* scheme;
    const char* warp;
    WarpRule rule;
    bool faces;
};

constexpr std::array<NamedScheme, 10> kSchemes{{
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
}};

void add(SchemeRow& row, const Aliasing& unit, double sheared) {
    row.storageFactor += unit.x * unit.z;
    row.shearedStorageFactor += unit.x * sheared;
    row.worstX = std::max(row.worstX, unit.x);
    row.worstZ = std::max(row.worstZ, unit.z);
}

SchemeRow schemeRow(const ViewFrustum& frustum, const glm::dvec3& light, const NamedScheme& named, int slices) {
    Scheme scheme;
    scheme.warp.rule = named.rule;
    scheme.faces = named.faces;
    scheme.slices = slices;
    const std::vector<SchemeMap> maps = schemeMaps(frustum, light, scheme);
    SchemeRow row{named.scheme, named.warp, slices, maps.size()};
    for (const SchemeMap& map : maps)
        add(row, map.unit, map.sheared);
    return row;
}

/// Returns the costs of two shadow map schemes: warped slices that share the orientation of the smallest storage factor
/// S, and stable slices.
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
    constexpr int kMaxSlices = 8;
    for (const NamedScheme& named : kSchemes)
        for (int k = 1; k <= kMaxSlices; ++k)
            table.push_back(schemeRow(frustum, towardsLight, named, k));
    for (const std::size_t kind : {std::size_t{0}, std::size_t{1}})
        for (int k = 1; k <= kMaxSlices; ++k)
            table.push_back(sliceRows(frustum, towardsLight, k)[kind]);
    return table;
}

} // namespace gnomon::theory
