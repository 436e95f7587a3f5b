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

/// Returns the smallest and the largest known value of a column, or nullopt if no value is known.
std::optional<report::Range> range(
    const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    std::optional<report::Range> result;
    for (const telemetry::FrameRow& row : rows)
        if (const auto value = row.*column)
            result = result ? report::Range{std::min(result->low, *value), std::max(result->high, *value)}
                            : report::Range{*value, *value};
    return result;
}

std::optional<double> largest(
    const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    std::optional<double> result;
    for (const telemetry::FrameRow& row : rows)
        if (row.*column) result = std::max(result.value_or(*(row.*column)), *(row.*column));
    return result;
}

/// Adds the frame times in the order of the path to `summary`: the median over the repetitions, and their range.
void addTimesAlongPath(const std::vector<telemetry::FrameRow>& rows, report::RunSummary& summary) {
    std::map<std::int64_t, std::vector<double>> times;
    std::size_t repetitions = 0;
    for (const telemetry::FrameRow& row : rows) {
        times[row.frame].push_back(row.totalMs.value_or(0));
        repetitions = std::max(repetitions, times[row.frame].size());
    }
    for (const auto& [frame, values] : times) {
        summary.frameMs.push_back(telemetry::quantile(values, 0.5));
        const auto [min, max] = std::minmax_element(values.begin(), values.end());
        if (repetitions > 1) summary.frameRanges.push_back({*min, *max});
    }
}

report::StageTimes medianStages(const std::vector<telemetry::FrameRow>& rows) {
    using telemetry::FrameRow;
    return {
        median(rows, &FrameRow::planMs),
        median(rows, &FrameRow::selectMs),
        median(rows, &FrameRow::cullMs),
        median(rows, &FrameRow::streamMs),
        median(rows, &FrameRow::shadowMs),
        median(rows, &FrameRow::imageMs)};
}

/// Adds the median times of the stages to `summary`, and the smallest and largest medians of the repetitions.
void addStages(const std::vector<telemetry::FrameRow>& rows, report::RunSummary& summary) {
    using report::StageTimes;
    summary.stages = medianStages(rows);
    std::map<std::int64_t, std::vector<telemetry::FrameRow>> repetitions;
    for (const telemetry::FrameRow& row : rows)
        repetitions[row.repetition].push_back(row);
    bool isFirst = true;
    for (const auto& [repetition, its] : repetitions) {
        const StageTimes times = medianStages(its);
        if (isFirst) summary.minStages = summary.maxStages = times;
        isFirst = false;
        for (double StageTimes::*stage :
             {&StageTimes::plan,
              &StageTimes::select,
              &StageTimes::cull,
              &StageTimes::stream,
              &StageTimes::shadow,
              &StageTimes::image}) {
            summary.minStages.*stage = std::min(summary.minStages.*stage, times.*stage);
            summary.maxStages.*stage = std::max(summary.maxStages.*stage, times.*stage);
        }
    }
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
    addStages(rows, s);
    s.imageTriangles = mean(rows, &FrameRow::imageTriangles);
    s.shadowTriangles = mean(rows, &FrameRow::shadowTriangles);
    if (aliasingBound > 0) s.errors[report::ErrorKind::AliasingBound] = aliasingBound;
    const auto addError = [&](report::ErrorKind kind, std::optional<double> value) {
        if (value) s.errors[kind] = *value;
    };
    addError(report::ErrorKind::WrongPixels, mean(rows, &FrameRow::wrongPixelsAll));
    if (isExact) s.errors.emplace(report::ErrorKind::WrongPixels, 0.0); // integer arithmetic also decides exact shadows
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
    for (const auto& [kind, column] :
         {std::pair(report::ErrorKind::WrongPixels, &FrameRow::wrongPixelsAll),
          std::pair(report::ErrorKind::ShadowEdge, &FrameRow::shadowEdgeP99Px)})
        if (const auto found = range(rows, column)) s.errorRanges[kind] = *found;
    addTimesAlongPath(rows, s);
    return s;
}

} // namespace gnomon::bench
