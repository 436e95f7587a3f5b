// z-partitioning: where the view frustum is cut into slices, and what the paper's schemes cost in closed form.
#pragma once

#include "shadow/fit/view_frustum.h"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// q - 1 for q = (far/near)^(1/k), the depth ratio of one self-similar slice; exact also where q is near 1.
double sliceRatioMinusOne(double near, double far, int count);

/// The `count` + 1 depths of self-similar slices, near and far included (Lloyd et al. 2006, Eqs 15 and 16).
std::vector<double> selfSimilarSplits(double near, double far, int count);

/// The practical split scheme (Zhang et al. 2006): `lambda` times the self-similar depths plus 1 - `lambda` times the
/// evenly spaced ones; lambda in [0, 1], 1 is self-similar.
std::vector<double> practicalSplits(double near, double far, int count, double lambda);

/// The slice that owns the view depth `depth`: the i with splits[i] <= depth < splits[i + 1]. Depths before the first
/// split belong to the first slice and those from the last split on to the last. Shaders repeat exactly this rule.
std::size_t sliceOf(std::span<const double> splits, double depth);

/// The storage factors of Eqs 17 to 21 and of appendix C at k slices, S summed over the maps.
struct ClosedForms {
    double zpOverhead = 0;       // Eq 17: slices, no warp, light overhead
    double zpWarpOverhead = 0;   // Eq 18: slices with warp; Eq 19 says that face partitions cost the same
    double zpBehindPaper = 0;    // Eq 20 as printed: it drops a strip of width 2 n tan(theta)
    double zpBehind = 0;         // k alpha^(2/k), exactly
    double facesBehindPaper = 0; // Eq 21 as printed: the near square is left out
    double facesBehind = 0;      // 2k(q - 1) + k, with the near square: five maps a slice
    double optimal = 0;          // ln(alpha) / (2 tan(theta)): the logarithmic map
};

ClosedForms closedForms(const ViewFrustum& frustum, int count);

/// How S grows with the depth ratio at j maps, for large ratios: alpha^(2/j) with slices, light overhead (Eq 22), and
/// alpha^(4/j) with face partitions, whose four maps a slice only a light *behind* needs (Eq 23, which the paper
/// labels overhead).
struct LargeRatioForms {
    double zpOverhead = 0;
    double facesBehind = 0;
};

LargeRatioForms largeRatioForms(double depthRatio, int mapCount);

} // namespace gnomon::shadow
