// Chooses the strength of the perspective warp of each shadow map: kappa = 1/n', the inverse distance of the warp's
// centre. The code stores kappa instead of n', because kappa is 0 for an orthogonal map. When the light becomes
// parallel to the view, kappa stays finite and continuous, but n' does not.
#pragma once

#include "core/words.h"
#include "shadow/fit/light_fit.h"
#include "shadow/partition/faces.h"

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::shadow {

/// The rules that choose the strength kappa of a warp; docs/shadow_theory.md compares them.
enum class WarpRule : std::uint8_t {
    None,       // kappa = 0
    Psm,        // kappa = 1/near (Stamminger and Drettakis 2002 for an overhead light; otherwise in light space)
    Lspsm,      // Wimmer et al. 2004 for a tilted light
    Tsm,        // Martin and Tan 2004: maps the focus to t = 0.8
    Minimax,    // smallest M_z over the vertices
    Auto,       // smallest S for kappa up to the minimax value
    MinStorage, // smallest S over all kappa >= 0
    Eta,        // n' from eta by Eq 11
    Given,      // the given kappa
    Log,        // logarithmic rows (Lloyd 2007), with the kappa of the smallest S
};

/// The warp rules that the command line offers, with their words.
inline constexpr std::array kWarpRules = {
    Word<WarpRule>{WarpRule::None, "none"},
    Word<WarpRule>{WarpRule::Lspsm, "lspsm"},
    Word<WarpRule>{WarpRule::Psm, "psm"},
    Word<WarpRule>{WarpRule::Tsm, "tsm"},
    Word<WarpRule>{WarpRule::Minimax, "minimax"},
    Word<WarpRule>{WarpRule::Auto, "auto"},
    Word<WarpRule>{WarpRule::Log, "log"},
};

/// Returns the name of the warp rule `rule`, also for rules without a word on the command line.
constexpr std::string_view name(WarpRule rule) {
    constexpr std::array kOthers = {
        Word<WarpRule>{WarpRule::MinStorage, "sopt"},
        Word<WarpRule>{WarpRule::Eta, "eta"},
        Word<WarpRule>{WarpRule::Given, "given"},
    };
    const std::string_view word = wordOf(kWarpRules, rule);
    return word.empty() ? wordOf(kOthers, rule) : word;
}

/// A rule that chooses the strength of a perspective warp, with its parameters.
struct Warp {
    WarpRule rule = WarpRule::Auto;
    double eta = 0; // for Eta: in [-1, 1]
    /// For Tsm: distance from the near plane to the focus, in world units, above 0. The default is tsmFocusDepth.
    std::optional<double> tsmFocus;
    double tsmFraction = 0.8;
    double kappa = 0; // for Given: 1 / world units, >= 0

    bool operator==(const Warp&) const = default;
};

/// Returns the warp strength kappa of LSPSM (Wimmer et al. 2004): n' = (n + sqrt(n (n + d sin gamma))) / sin gamma.
double kappaLspsm(const LightFit& fit);

/// Returns the warp strength kappa of a trapezoidal shadow map, which moves zeta = `focusZeta` to t = `fraction`.
/// Returns 0 if focusZeta >= fraction d. kappa d is limited to 1e6, because kappa would become infinite for a focus at
/// the near side.
double kappaTsm(const LightFit& fit, double focusZeta, double fraction);

/// Returns the default focus of a trapezoidal shadow map for `slice`, as a view depth: sqrt(near far). This depth
/// divides the slice into two parts with equal depth ratios.
double tsmFocusDepth(const ViewFrustum& slice);

/// Returns `warp` for one slice of the frustum `whole`. The focus of a trapezoidal shadow map is scaled with the slice.
Warp warpOfSlice(const Warp& warp, const ViewFrustum& whole, const ViewFrustum& slice);

/// Returns the warp strength kappa that minimises the aliasing M_z over the vertices, in closed form. Let a and b be
/// the max zeta of the near and of the far vertices, and r = sqrt(f/n). With growing kappa, the aliasing of the near
/// side falls until (d - 2a)/(a d). The aliasing of the far side can become the larger one earlier, at (r - 1)/(b - r
/// a). It can then still fall until (d - 2b)/(b d).
double kappaMinimax(const LightFit& fit);

/// Returns the warp strength kappa in [0, kappaMinimax] with the smallest storage factor S, by golden-section search in
/// log(1 + kappa d). S is unimodal in this range. The result is never worse than kappa = 0 or kappaMinimax.
double kappaAuto(const LightFit& fit);

/// Returns the warp strength kappa >= 0 with the smallest storage factor S, by a scan and golden-section search. The
/// function is slow and is only for comparisons.
double kappaMinStorage(const LightFit& fit);

/// Returns the row spacing of shadow maps with the warp rule `rule`.
constexpr RowSpacing rowsOf(WarpRule rule) {
    return rule == WarpRule::Log ? RowSpacing::Logarithmic : RowSpacing::Even;
}

/// Returns the kappa of a warp whose centre is the eye: 1 / zMin of the region. Returns nullopt if the eye is not in
/// front of the region.
std::optional<double> kappaAtEye(const LightFit& fit);

/// The effort of the search in kappaLog. Rough is faster, for the comparison of many maps.
///
/// kappaLog returns the kappa with the smallest storage factor S for logarithmic rows. With the light overhead, the
/// best centre of the warp is the eye, where S = ln(f/n) / (2 tan theta). At 0.3 times that kappa, S is already 9 times
/// as large, and the rules Auto and Minimax cannot select the kappa of the eye. In all other cases the function
/// searches between no warp and a centre far behind the eye.
enum class Search : std::uint8_t { Fine, Rough };
double kappaLog(const LightFit& fit, Search search = Search::Fine);

/// Returns the warp strength kappa that the rule `warp` chooses for the region `fit`.
double kappaOf(const Warp& warp, const LightFit& fit);

/// Returns the warp strength kappa that the rule `warp` chooses for the map of `face`. The near face has kappa 0. A
/// side face with logarithmic rows has a warp about the eye, so that m_x and m_z are constant over the face.
double kappaOfMap(const Warp& warp, const LightFit& fit, Face face);

} // namespace gnomon::shadow
