#include "plan/empty_slices.h"

#include "plan/hysteresis.h"

#include <algorithm>
#include <limits>

namespace gnomon::plan {

namespace {

/// Returns the union of `spans` and `more` as disjoint, sorted depth spans.
std::vector<DepthSpan> joined(std::vector<DepthSpan> spans, std::span<const DepthSpan> more) {
    spans.insert(spans.end(), more.begin(), more.end());
    std::sort(spans.begin(), spans.end(), [](const DepthSpan& a, const DepthSpan& b) { return a.near < b.near; });
    std::vector<DepthSpan> result;
    for (const DepthSpan& span : spans) {
        if (!result.empty() && span.near <= result.back().far)
            result.back().far = std::max(result.back().far, span.far);
        else
            result.push_back(span);
    }
    return result;
}

} // namespace

Receivers receiversNow(
    std::span<const DepthSpan> lit, const std::optional<SchemeMemory>& before, std::span<const double> splits) {
    Receivers result;
    result.memory.since = joined({}, lit);
    if (!before) return result;
    result.haveArrived = (before->emptySlices & ~slicesWithout(lit, splits)) != 0;
    if (result.haveArrived) return result;
    const LitMemory& past = before->lit;
    result.memory = {past.before, joined(past.since, lit), past.frames + 1};
    if (result.memory.frames < kFramesBeforeMapsGo) return result;
    result.isStretchOver = true;
    result.over = std::move(result.memory.since);
    result.memory = {result.over, joined({}, lit), 0};
    return result;
}

std::uint64_t slicesWithout(std::span<const DepthSpan> lit, std::span<const double> splits) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
        const double near = i == 0 ? 0 : splits[i];
        const double far = i + 2 == splits.size() ? std::numeric_limits<double>::infinity() : splits[i + 1];
        const auto isIn = [&](const DepthSpan& span) { return span.near <= far && span.far >= near; };
        if (std::none_of(lit.begin(), lit.end(), isIn)) result |= std::uint64_t{1} << i;
    }
    return result;
}

std::uint64_t slicesWithoutMap(
    const Receivers& receivers, std::span<const double> splits, const SchemeMemory& before, bool isSameScheme) {
    if (receivers.haveArrived) return 0;
    if (isSameScheme) return before.emptySlices | (receivers.isStretchOver ? slicesWithout(receivers.over, splits) : 0);
    if (!receivers.memory.before) return 0;
    return slicesWithout(*receivers.memory.before, splits) & slicesWithout(receivers.memory.since, splits);
}

} // namespace gnomon::plan
