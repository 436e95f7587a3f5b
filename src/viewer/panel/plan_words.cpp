#include "viewer/panel/plan_words.h"

#include "core/formatted.h"
#include "core/units.h"
#include "settings/plan_sentences.h"

#include <algorithm>

namespace gnomon::viewer {

namespace {

std::string mapsInWords(const plan::FramePlan& plan) {
    const plan::Quality& quality = plan.quality;
    if (quality.shadows == plan::ShadowMode::Off) return "no shadows";
    if (quality.shadows == plan::ShadowMode::Rays) return "shadows by rays";
    if (quality.shadows == plan::ShadowMode::Exact) return "exact shadows";
    if (plan.passes.empty()) return "no shadow map is called for";
    const std::size_t slices = plan.splits.empty() ? 1 : plan.splits.size() - 1;
    std::string words = formatted("%zu map%s", plan.passes.size(), plan.passes.size() == 1 ? "" : "s");
    if (slices > 1) words += formatted(", %zu slices", slices);
    if (plan.hasFaces) words += ", by faces";
    words += quality.stabilize ? ", stabilised" : ", warp " + std::string(shadow::name(quality.warp.rule));
    return words +
           formatted(" (%s), %d x %d texels", plan::schemeName(plan).c_str(), plan.textureWidth, plan.textureHeight);
}

std::string boundInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row) {
    if (!row.aliasingBoundX) return mapsInWords(plan);
    const std::size_t maps = plan.passes.size();
    return formatted(
        "%zu map%s, aliasing bound %.2g",
        maps,
        maps == 1 ? "" : "s",
        std::max(*row.aliasingBoundX, *row.aliasingBoundZ));
}

} // namespace

std::string statusInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row, const PictureState& state) {
    constexpr const char* kBetween = " \xC2\xB7 ";
    const auto triangles = static_cast<std::uint64_t>(row.imageTriangles.value_or(0));
    std::string words = formatted("%.0f ms", state.frameMs) + kBetween + readableCount(triangles) + " triangles" +
                        kBetween + boundInWords(plan, row);
    if (!state.reductions.empty()) words += kBetween + ("given up: " + state.reductions);
    if (row.pagesMissing.value_or(0) > 0)
        words += kBetween + formatted("loading %lld pages", static_cast<long long>(*row.pagesMissing));
    if (row.pagesDamaged.value_or(0) > 0)
        words += kBetween + formatted("%lld pages DAMAGED", static_cast<long long>(*row.pagesDamaged));
    if (state.samples > 0 && state.samples < state.maxSamples)
        words += kBetween + formatted("sample %d of %d", state.samples, state.maxSamples);
    return words;
}

std::vector<std::string> planInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row) {
    std::vector<std::string> lines = {mapsInWords(plan)};
    if (plan.far > plan.near && plan.near > 0)
        lines.push_back(formatted(
            "depths %.4g to %.4g, ratio %.3g",
            depthFromAskedEye(plan, plan.near),
            depthFromAskedEye(plan, plan.far),
            plan.far / plan.near));
    lines.push_back(formatted("light %.0f\xC2\xB0 from the view", row.lightAngle.value_or(0)));
    if (row.aliasingBoundX) {
        lines.back() += formatted(", storage factor %.3g", row.storageFactor.value_or(0));
        lines.push_back(formatted("aliasing bound %.3g across, %.3g along", *row.aliasingBoundX, *row.aliasingBoundZ));
        const bool isAuto = !plan.quality.zPartitions || plan.quality.facePartitions == plan::Choice::Auto;
        if (isAuto)
            lines.back() +=
                formatted(": %s %.3g", plan.isBoundKept ? "kept under" : "NOT under", plan.quality.maxAliasing);
    }
    if (row.measuredAliasing)
        lines.push_back(formatted("measured aliasing %.3g", *row.measuredAliasing));
    else if (row.aliasingBoundX)
        lines.emplace_back("measured aliasing: not yet");
    if (row.wrongShadowFraction) lines.push_back(formatted("measured %.3g%% wrong", 100 * *row.wrongShadowFraction));
    for (const plan::SkippedEffect& skipped : plan.omitted)
        lines.push_back("without " + settings::effectInWords(skipped) + ": " + settings::reasonInWords(skipped));
    return lines;
}

std::vector<std::string> loadInWords(
    const telemetry::FrameRow& row, const plan::Quality& quality, const Caps& caps, std::uint64_t pagesInCut) {
    const auto count = [](const std::optional<std::int64_t>& value) {
        return static_cast<std::uint64_t>(value.value_or(0));
    };
    std::vector<std::string> lines;
    lines.push_back(formatted(
        "triangles %s in view, %s into maps",
        readableCount(count(row.imageTriangles)).c_str(),
        readableCount(count(row.shadowTriangles)).c_str()));
    if (quality.maxTriangles) lines.back() += formatted(" (cap %s)", readableCount(*quality.maxTriangles).c_str());
    lines.push_back(formatted(
        "detail %.3g px, achieved %.3g px", row.errorPixels, row.achievedErrorPixels.value_or(row.errorPixels)));
    lines.push_back(formatted(
        "pages %llu of %llu in the cut",
        static_cast<unsigned long long>(pagesInCut),
        static_cast<unsigned long long>(caps.pages)));
    if (count(row.pagesMissing) > 0)
        lines.back() += formatted(", %llu on their way", static_cast<unsigned long long>(count(row.pagesMissing)));
    if (count(row.pagesDamaged) > 0)
        lines.back() += formatted(", %llu DAMAGED", static_cast<unsigned long long>(count(row.pagesDamaged)));
    lines.push_back(formatted(
        "memory %s of %s",
        readableBytes({count(row.residentBytes)}).c_str(),
        readableBytes({caps.memoryBytes}).c_str()));
    if (row.gpuBytes)
        lines.push_back(formatted(
            "drawing %s of %s (%s)",
            readableBytes({count(row.gpuBytes)}).c_str(),
            readableBytes({caps.gpuMemoryBytes}).c_str(),
            row.backend.c_str()));
    return lines;
}

} // namespace gnomon::viewer
