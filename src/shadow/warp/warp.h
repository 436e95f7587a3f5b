// The warp rules: how kappa = 1/n' of a map is chosen. Carried as kappa, which is 0 for an orthogonal map and stays
// finite and continuous as the light turns parallel to the view, where n' does neither.
#pragma once

#include "core/words.h"
#include "shadow/fit/light_fit.h"
#include "shadow/partition/faces.h"

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::shadow {

/// The rules; docs/shadow_theory.md compares them.
enum class WarpRule : std::uint8_t {
    None,         // kappa = 0
    Psm,          // kappa = 1/near (Stamminger and Drettakis 2002, light overhead; elsewhere in the light's frame)
    Lspsm,        // Wimmer et al. 2004 for a tilted light
    Tsm,          // Martin and Tan 2004: the focus maps to t = 0.8
    Minimax,      // the least M_z over the vertices
    Auto,         // the least S with kappa up to the minimax one
    LeastStorage, // the least S over every kappa >= 0
    Eta,          // n' from eta by Eq 11
    Given,        // kappa itself
    Log,          // logarithmic rows (Lloyd 2007), and of kappa the least S with them
};

/// Those that are asked for by a word.
inline constexpr std::array kWarpRules = {
    Word<WarpRule>{WarpRule::None, "none"},
    Word<WarpRule>{WarpRule::Lspsm, "lspsm"},
    Word<WarpRule>{WarpRule::Psm, "psm"},
    Word<WarpRule>{WarpRule::Tsm, "tsm"},
    Word<WarpRule>{WarpRule::Minimax, "minimax"},
    Word<WarpRule>{WarpRule::Auto, "auto"},
    Word<WarpRule>{WarpRule::Log, "log"},
};

/// The word for `rule`, also where it is asked for in another way.
constexpr std::string_view name(WarpRule rule) {
    constexpr std::array kOthers = {
        Word<WarpRule>{WarpRule::LeastStorage, "sopt"},
        Word<WarpRule>{WarpRule::Eta, "eta"},
        Word<WarpRule>{WarpRule::Given, "given"},
    };
    const std::string_view word = wordOf(kWarpRules, rule);
    return word.empty() ? wordOf(kOthers, rule) : word;
}

/// A rule with its parameters.
struct Warp {
    WarpRule rule = WarpRule::Auto;
    double eta = 0; // Eta: in [-1, 1]
    std::optional<double>
        tsmFocus; // Tsm: view distance of the focus from near, world units, > 0; nothing: tsmFocusDepth
    double tsmFraction = 0.8;
    double kappa = 0; // Given: 1 / world units, >= 0

    bool operator==(const Warp&) const = default;
};

/// Wimmer's rule: n' = (n + sqrt(n (n + d sin gamma))) / sin gamma.
double kappaLspsm(const LightFit& fit);

/// The kappa that maps `focusZeta` to t = `fraction`; 0 from focusZeta = fraction d on. kappa d is capped at 1e6, which
/// a focus on the near side would exceed without bound.
double kappaTsm(const LightFit& fit, double focusZeta, double fraction);

/// The view depth that a TSM of `slice` takes for its focus where none is given: sqrt(near far), which divides the
/// slice into two of equal depth ratio.
double tsmFocusDepth(const ViewFrustum& slice);

/// The part of `warp` that a slice of `whole` gets: the focus lies in the slice where it does in the whole, to scale.
Warp warpOfSlice(const Warp& warp, const ViewFrustum& whole, const ViewFrustum& slice);

/// The kappa of least M_z over the vertices, in closed form: with a and b the largest zeta of the near and of the far
/// vertices and r = sqrt(f/n): (d - 2a)/(a d), where the near side's error stops falling, unless the far side's
/// overtakes it before, at (r - 1)/(b - r a), which then may fall until (d - 2b)/(b d).
double kappaMinimax(const LightFit& fit);

/// The kappa in [0, kappaMinimax] of least S, by golden section in log(1 + kappa d); S is unimodal there. Never worse
/// than no warp nor than minimax.
double kappaAuto(const LightFit& fit);

/// The kappa >= 0 of least S, by a scan and golden sections: slow, for comparison only.
double kappaLeastStorage(const LightFit& fit);

/// The rows of the maps that `rule` warps.
constexpr RowSpacing rowsOf(WarpRule rule) {
    return rule == WarpRule::Log ? RowSpacing::Logarithmic : RowSpacing::Even;
}

/// The kappa of a warp about the eye: one over its distance in front of the region's least z; nothing where that is not
/// in front.
std::optional<double> kappaAtEye(const LightFit& fit);

/// The kappa of least S with logarithmic rows. About the eye with the light overhead, where neither `auto` nor minimax
/// may choose it: S = ln(f/n) / (2 tan theta) there, and 9 times that already with 0.3 of that kappa. Elsewhere it is
/// sought between no warp and far behind the eye; roughly, where many fits are compared.
enum class Search : std::uint8_t { Fine, Rough };
double kappaLog(const LightFit& fit, Search search = Search::Fine);

/// The kappa that `warp` chooses for `fit`.
double kappaOf(const Warp& warp, const LightFit& fit);

/// The kappa that `warp` chooses for the map of `face`: none for a near square, and about the eye for a side face with
/// logarithmic rows, which then are a rectangle of constant m_x and m_z.
double kappaOfMap(const Warp& warp, const LightFit& fit, Face face);

} // namespace gnomon::shadow
