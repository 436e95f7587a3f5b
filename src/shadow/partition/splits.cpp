#include "shadow/partition/splits.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

double sliceRatioMinusOne(double near, double far, int count) {
    return std::expm1(std::log1p((far - near) / near) / count);
}

std::vector<double> selfSimilarSplits(double near, double far, int count) {
    return practicalSplits(near, far, count, 1);
}

std::vector<double> practicalSplits(double near, double far, int count, double lambda) {
    GNOMON_CHECK_OP(count, >=, 1);
    std::vector<double> splits(static_cast<std::size_t>(count) + 1);
    const double logRatio = std::log1p((far - near) / near);
    for (int i = 0; i <= count; ++i) {
        const double fraction = static_cast<double>(i) / count;
        const double similar = near + near * std::expm1(logRatio * fraction);
        const double even = near + (far - near) * fraction;
        splits[static_cast<std::size_t>(i)] = lambda * similar + (1 - lambda) * even;
    }
    splits.front() = near;
    splits.back() = far;
    return splits;
}

std::size_t sliceOf(std::span<const double> splits, double depth) {
    GNOMON_CHECK_OP(splits.size(), >=, std::size_t{2});
    const auto inner = splits.subspan(1, splits.size() - 2);
    return static_cast<std::size_t>(std::upper_bound(inner.begin(), inner.end(), depth) - inner.begin());
}

ClosedForms closedForms(const ViewFrustum& frustum, int count) {
    const double step = sliceRatioMinusOne(frustum.near, frustum.far, count);
    const double q = 1 + step;
    const double k = count;
    const double twoTan = 2 * tanHalfY(frustum);
    ClosedForms forms;
    forms.zpOverhead = k * q * step / twoTan;
    forms.zpWarpOverhead = k * step / twoTan;
    forms.zpBehindPaper = k * q * step;
    forms.zpBehind = k * q * q;
    forms.facesBehindPaper = 2 * k * step;
    forms.facesBehind = 2 * k * step + k;
    forms.optimal = std::log1p((frustum.far - frustum.near) / frustum.near) / twoTan;
    return forms;
}

LargeRatioForms largeRatioForms(double depthRatio, int mapCount) {
    return {std::pow(depthRatio, 2.0 / mapCount), std::pow(depthRatio, 4.0 / mapCount)};
}

} // namespace gnomon::shadow
