#include "bench/summarize.h"

#include "settings/table.h"
#include "telemetry/benchmark_report.h"

#include <algorithm>
#include <map>
#include <optional>

namespace gnomon::bench {

namespace {

double median(const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    std::vector<double> values;
    for (const telemetry::FrameRow& row : rows)
        if (row.*column) values.push_back(*(row.*column));
    return values.empty() ? 0 : telemetry::quantile(values, 0.5);
}

double mean(const std::vector<telemetry::FrameRow>& rows, std::optional<std::int64_t> telemetry::FrameRow::*column) {
    double sum = 0;
    for (const telemetry::FrameRow& row : rows)
        sum += static_cast<double>((row.*column).value_or(0));
    return rows.empty() ? 0 : sum / static_cast<double>(rows.size());
}

std::optional<double> mean(
    const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    double sum = 0;
    int count = 0;
    for (const telemetry::FrameRow& row : rows) {
        if (!(row.*column)) continue;
        sum += *(row.*column);
        ++count;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> largest(
    const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    std::optional<double> result;
    for (const telemetry::FrameRow& row : rows)
        if (row.*column) result = std::max(result.value_or(*(row.*column)), *(row.*column));
    return result;
}

/// Returns the frame times in the order of the path. Each is the median over the repetitions.
std::vector<double> timesAlongPath(const std::vector<telemetry::FrameRow>& rows) {
    std::map<std::int64_t, std::vector<double>> times;
    for (const telemetry::FrameRow& row : rows)
        times[row.frame].push_back(row.totalMs.value_or(0));
    std::vector<double> result;
    result.reserve(times.size());
    for (const auto& [frame, values] : times)
        result.push_back(telemetry::quantile(values, 0.5));
    return result;
}

/// Returns the noise of the frame times, (max - min) / (max + min) of the medians of the repetitions. Returns nullopt
/// for a single repetition.
std::optional<double> noise(const std::vector<telemetry::FrameRow>& rows) {
    std::map<std::int64_t, std::vector<double>> times;
    for (const telemetry::FrameRow& row : rows)
        times[row.repetition].push_back(row.totalMs.value_or(0));
    if (times.size() < 2) return std::nullopt;
    std::vector<double> medians;
    medians.reserve(times.size());
    for (const auto& [repetition, values] : times)
        medians.push_back(telemetry::quantile(values, 0.5));
    const auto [min, largest] = std::minmax_element(medians.begin(), medians.end());
    return *min + *largest > 0 ? (*largest - *min) / (*largest + *min) : 0;
}

} // namespace

report::RunSummary summarize(const RunResult& result) {
    using telemetry::FrameRow;
    const auto& rows = result.rows;
    report::RunSummary s;
    s.name = result.run.name;
    s.options = result.run.options;
    for (const settings::Setting& setting : settings::table())
        if (setting.description().isSwept) s.settings[setting.column()] = setting.text(result.run.settings);
    const bool isExact = !rows.empty() && rows.front().scheme == "exact";
    if (isExact) s.settings["cells"] = wordOf(plan::kCellSchemes, result.run.settings.quality.cellScheme);
    if (!rows.empty()) s.scheme = isExact ? s.settings["cells"] : rows.front().scheme;
    std::vector<double> totals;
    double aliasingBound = 0;
    for (const FrameRow& row : rows) {
        totals.push_back(row.totalMs.value_or(0));
        aliasingBound = std::max({aliasingBound, row.aliasingBoundX.value_or(0), row.aliasingBoundZ.value_or(0)});
        s.shadowMaps = std::max(s.shadowMaps, static_cast<int>(row.shadowMaps));
        s.storageFactor = std::max(s.storageFactor, row.storageFactor.value_or(0));
        s.isBoundKept = s.isBoundKept && row.isBoundKept.value_or(true);
        s.pagesDamaged = std::max(s.pagesDamaged, static_cast<std::uint64_t>(row.pagesDamaged.value_or(0)));
        s.pagesMissing = std::max(s.pagesMissing, static_cast<std::uint64_t>(row.pagesMissing.value_or(0)));
    }
    s.p50Ms = telemetry::quantile(totals, 0.50);
    s.p95Ms = telemetry::quantile(totals, 0.95);
    s.p99Ms = telemetry::quantile(totals, 0.99);
    s.noise = noise(rows);
    s.stages = {
        median(rows, &FrameRow::planMs),
        median(rows, &FrameRow::selectMs),
        median(rows, &FrameRow::cullMs),
        median(rows, &FrameRow::streamMs),
        median(rows, &FrameRow::shadowMs),
        median(rows, &FrameRow::imageMs)};
    s.imageTriangles = mean(rows, &FrameRow::imageTriangles);
    s.shadowTriangles = mean(rows, &FrameRow::shadowTriangles);
    if (aliasingBound > 0) s.errors[report::ErrorKind::AliasingBound] = aliasingBound;
    const auto addError = [&](report::ErrorKind kind, std::optional<double> value) {
        if (value) s.errors[kind] = *value;
    };
    addError(report::ErrorKind::WrongPixels, mean(rows, &FrameRow::wrongPixelsAll));
    addError(report::ErrorKind::MeasuredAliasing, largest(rows, &FrameRow::measuredAliasing));
    // A caster thinner than a texel counts as missed, not as wrong. Coarse maps miss more casters, so only the sum is
    // comparable between maps of different texels.
    if (const auto wrong = mean(rows, &FrameRow::wrongShadowFraction))
        s.errors[report::ErrorKind::WrongShadow] = *wrong + mean(rows, &FrameRow::missedShadowFraction).value_or(0);
    // In a frame with almost no shadow edges, a single edge without a counterpart has a distance of up to the picture's
    // width. The median over the frames ignores such outliers.
    if (mean(rows, &FrameRow::shadowEdgeP99Px))
        s.errors[report::ErrorKind::ShadowEdge] = median(rows, &FrameRow::shadowEdgeP99Px);
    addError(report::ErrorKind::ImageDifference, mean(rows, &FrameRow::imageDifference));
    s.crawl = mean(rows, &FrameRow::crawl).value_or(-1);
    s.frameMs = timesAlongPath(rows);
    return s;
}

} // namespace gnomon::bench
