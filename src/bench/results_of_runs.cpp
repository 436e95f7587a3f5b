#include "bench/results_of_runs.h"

#include "bench/summarize.h"
#include "core/formatted.h"
#include "telemetry/process_clock.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

namespace gnomon::bench {

namespace {

using telemetry::FrameRow;

std::string part(std::string text) {
    std::replace(text.begin(), text.end(), '/', '_');
    return text.empty() ? "none" : text;
}

std::string stemIn(const std::map<std::string, std::string>& context, const char* key) {
    const auto found = context.find(key);
    return found == context.end() ? "" : std::filesystem::path(found->second).stem().string();
}

/// Adds the sum of a column over the first repetition, if all its rows have it.
void addSum(
    const RunResult& result,
    const char* name,
    std::initializer_list<std::optional<std::int64_t> FrameRow::*> columns,
    RunRecord& run) {
    double sum = 0;
    bool isKnown = false;
    for (const FrameRow& row : result.rows) {
        if (row.repetition != 0) continue;
        for (const auto column : columns) {
            if (!(row.*column)) continue;
            isKnown = true;
            sum += static_cast<double>(*(row.*column));
        }
    }
    if (isKnown) run.work[name] = sum;
}

/// Adds the last value of a column that counts from the start of the process, in the first repetition.
void addTotal(
    const RunResult& result, const char* name, std::optional<std::int64_t> FrameRow::*column, RunRecord& run) {
    for (const FrameRow& row : result.rows)
        if (row.repetition == 0 && row.*column) run.work[name] = static_cast<double>(*(row.*column));
}

void addWork(const RunResult& result, RunRecord& run) {
    addSum(result, "triangles", {&FrameRow::imageTriangles, &FrameRow::shadowTriangles}, run);
    addSum(result, "fragments", {&FrameRow::shadowFragments}, run);
    addSum(result, "sample_tests", {&FrameRow::sampleTests}, run);
    addTotal(result, "bytes_read", &FrameRow::bytesRead, run);
    addTotal(result, "pages", &FrameRow::pagesRead, run);
}

void addTimes(const RunResult& result, RunRecord& run) {
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const FrameRow& row = result.rows[i];
        if (i == 0 || row.repetition != result.rows[i - 1].repetition) {
            run.realMs.emplace_back();
            run.cpuMs.emplace_back();
        }
        run.realMs.back().push_back(row.totalMs.value_or(0));
        run.cpuMs.back().push_back(i < result.rowCpuMs.size() ? result.rowCpuMs[i] : result.cpuMs);
    }
}

} // namespace

std::string fullName(const std::map<std::string, std::string>& context, const RunResult& result) {
    const FrameRow row = result.rows.empty() ? FrameRow() : result.rows.front();
    const std::string scheme = result.run.scheme.empty() ? result.run.name : result.run.scheme;
    return part(stemIn(context, "model")) + "/" + part(stemIn(context, "path")) + "/" + part(scheme) + "/" +
           std::to_string(row.width) + "x" + std::to_string(row.height) + "/" + part(result.run.error) + "/" +
           part(row.backend);
}

ResultSet resultSet(
    const std::map<std::string, std::string>& context, const std::vector<RunResult>& results, bool isRealTime) {
    ResultSet set;
    set.context = context;
    for (const RunResult& result : results) {
        const report::RunSummary summary = summarize(result);
        RunRecord& run = set.runs.emplace_back();
        run.name = fullName(context, result);
        run.label = result.run.name;
        addTimes(result, run);
        if (!isRealTime) addWork(result, run);
        for (const auto& [kind, value] : summary.errors)
            run.errors[std::string(report::key(kind))] = value;
        run.facts["shadow_maps"] = summary.shadowMaps;
        if (summary.storageFactor > 0) run.facts["storage_factor"] = summary.storageFactor;
        if (&result == &results.front()) {
            run.process[kFirstPicture] = {result.firstFrameMs};
            run.process[kPeakMemory] = {static_cast<double>(telemetry::peakResident().count)};
        }
        run.pagesDamaged = summary.pagesDamaged;
        run.pagesMissing = summary.pagesMissing;
    }
    return set;
}

} // namespace gnomon::bench
