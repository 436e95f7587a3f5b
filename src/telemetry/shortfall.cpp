#include "telemetry/shortfall.h"

#include "core/formatted.h"

#include <algorithm>

namespace gnomon::telemetry {

namespace {

constexpr double kRounding = 1 + 1e-6;

bool missesError(const DrawnDetail& detail) {
    return detail.achievedPixels > detail.askedPixels * kRounding;
}

} // namespace

void Shortfall::add(const DrawnDetail& detail) {
    const bool isTold = detail.isDamaged && detail.pagesMissing == 0;
    if (isTold || (detail.pagesMissing == 0 && !missesError(detail))) return;
    isAny_ = true;
    worst_.askedPixels = detail.askedPixels;
    worst_.achievedPixels = std::max(worst_.achievedPixels, detail.achievedPixels);
    worst_.pagesMissing = std::max(worst_.pagesMissing, detail.pagesMissing);
}

void Shortfall::add(const FrameRow& row) {
    add(
        {row.errorPixels,
         row.achievedErrorPixels.value_or(0),
         static_cast<std::uint64_t>(row.pagesMissing.value_or(0)),
         row.pagesDamaged.value_or(0) > 0});
}

std::string Shortfall::text() const {
    if (!isAny_) return {};
    std::string text = "the model is drawn coarser than asked for: ";
    if (missesError(worst_))
        text += formatted("the error is up to %.3g pixels instead of %.3g", worst_.achievedPixels, worst_.askedPixels);
    else
        text += "shadows have coarser casters";
    if (worst_.pagesMissing == 0) return text + "; the cap of triangles allows no more";
    return text + formatted(
                      "; up to %llu pages do not fit into the page memory",
                      static_cast<unsigned long long>(worst_.pagesMissing));
}

} // namespace gnomon::telemetry
