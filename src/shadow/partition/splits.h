// Divides the view frustum into depth slices (z-partitioning), and computes the storage factors of the schemes of Lloyd
// et al. 2006 in closed form.
#pragma once

#include "shadow/fit/view_frustum.h"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// Returns q - 1 for q = (far/near)^(1/k), the depth ratio of one of k self-similar slices. The result is precise even
/// for q near 1.
double sliceRatioMinusOne(double near, double far, int count);

/// Returns the `count` + 1 split depths of self-similar slices, including near and far (Lloyd et al. 2006, Eqs 15 and
/// 16).
std::vector<double> selfSimilarSplits(double near, double far, int count);

/// Returns the split depths of the practical split scheme (Zhang et al. 2006): `lambda` times the self-similar depths
/// plus 1 - `lambda` times the evenly spaced depths. lambda is in [0, 1]; 1 is self-similar.
std::vector<double> practicalSplits(double near, double far, int count, double lambda);

/// Returns the index i of the slice with splits[i] <= depth < splits[i + 1]. Smaller depths belong to the first slice,
/// larger depths to the last slice. The shaders repeat this rule exactly.
std::size_t sliceOf(std::span<const double> splits, double depth);

/// The storage factors S, summed over the maps of k slices (Eqs 17 to 21 and appendix C of Lloyd et al. 2006).
struct ClosedForms {
    double zpOverhead = 0;       // Eq 17: slices without warp, light overhead
    double zpWarpOverhead = 0;   // Eq 18: slices with warp; by Eq 19, face partitions cost the same
    double zpBehindPaper = 0;    // Eq 20 as printed: it drops a strip of width 2 n tan(theta)
    double zpBehind = 0;         // the exact value, k alpha^(2/k)
    double facesBehindPaper = 0; // Eq 21 as printed: it omits the near square
    double facesBehind = 0;      // 2k(q - 1) + k, with the near square: five maps per slice
    double optimal = 0;          // ln(alpha) / (2 tan(theta)): the logarithmic map
};

ClosedForms closedForms(const ViewFrustum& frustum, int count);

/// The growth of the storage factor S with the depth ratio alpha = far / near, for j maps and large ratios. Slices with
/// an overhead light give alpha^(2/j) (Eq 22). Face partitions give alpha^(4/j) (Eq 23). Face partitions need four maps
/// per slice, but only for a light *behind* the viewer. The paper labels Eq 23 as overhead.
struct LargeRatioForms {
    double zpOverhead = 0;
    double facesBehind = 0;
};

LargeRatioForms largeRatioForms(double depthRatio, int mapCount);

} // namespace gnomon::shadow
