#include "bench/result_json.h"

#include "core/error.h"
#include "core/json_file.h"
#include "telemetry/benchmark_report.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace gnomon::bench {

namespace {

using Json = nlohmann::ordered_json;

// The prefixes of user counters, by which the reader knows the group of each.
constexpr const char* kWork = "work_";
constexpr const char* kErrors = "error_";
constexpr const char* kProcess = "process_";

double meanOf(const std::vector<double>& values) {
    if (values.empty()) return 0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Returns the standard deviation of a sample.
double deviationOf(const std::vector<double>& values) {
    if (values.size() < 2) return 0;
    const double mean = meanOf(values);
    double sum = 0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Returns `times` with six digits, because the file contains each frame.
Json rounded(const std::vector<double>& times) {
    Json list = Json::array();
    for (const double time : times) {
        const double step = time > 0 ? std::pow(10, std::floor(std::log10(time)) - 5) : 1;
        list.push_back(std::round(time / step) * step);
    }
    return list;
}

const std::vector<double>& cpuOf(const RunRecord& run, std::size_t repetition) {
    static const std::vector<double> kNone;
    return repetition < run.cpuMs.size() ? run.cpuMs[repetition] : kNone;
}

void addCounters(Json& entry, const RunRecord& run) {
    for (const auto& [key, value] : run.work)
        entry[kWork + key] = value;
    for (const auto& [key, value] : run.errors)
        entry[kErrors + key] = value;
    for (const auto& [key, value] : run.facts)
        entry[key] = value;
}

Json repetitionEntry(const RunRecord& run, std::size_t repetition, int threads) {
    const std::vector<double>& times = run.realMs[repetition];
    Json entry{
        {"name", run.name},
        {"run_name", run.name},
        {"run_type", "iteration"},
        {"repetitions", run.realMs.size()},
        {"repetition_index", repetition},
        {"threads", threads},
        {"iterations", times.size()},
        {"real_time", meanOf(times)},
        {"cpu_time", meanOf(cpuOf(run, repetition))},
        {"time_unit", "ms"},
        {"label", run.label},
        {"p50", telemetry::quantile(times, 0.50)},
        {"p95", telemetry::quantile(times, 0.95)},
        {"p99", telemetry::quantile(times, 0.99)},
        {"pages_damaged", run.pagesDamaged},
        {"pages_missing", run.pagesMissing}};
    addCounters(entry, run);
    // A process can have several repetitions. Each value is then in the first entry that is left.
    for (const auto& [key, values] : run.process)
        if (repetition < values.size()) entry[kProcess + key] = values[repetition];
    entry["frame_ms"] = rounded(times);
    entry["frame_cpu_ms"] = rounded(cpuOf(run, repetition));
    return entry;
}

/// Adds the aggregates that Google Benchmark writes for several repetitions.
void addAggregates(Json& list, const RunRecord& run, int threads) {
    std::vector<double> real;
    std::vector<double> cpu;
    for (std::size_t repetition = 0; repetition < run.realMs.size(); ++repetition) {
        real.push_back(meanOf(run.realMs[repetition]));
        cpu.push_back(meanOf(cpuOf(run, repetition)));
    }
    const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0; };
    const auto add = [&](const char* kind, const char* unit, double realValue, double cpuValue) {
        list.push_back(
            {{"name", run.name + "_" + kind},
             {"run_name", run.name},
             {"run_type", "aggregate"},
             {"repetitions", run.realMs.size()},
             {"threads", threads},
             {"aggregate_name", kind},
             {"aggregate_unit", unit},
             {"iterations", run.realMs.size()},
             {"real_time", realValue},
             {"cpu_time", cpuValue},
             {"time_unit", "ms"}});
    };
    add("mean", "time", meanOf(real), meanOf(cpu));
    add("median", "time", telemetry::quantile(real, 0.5), telemetry::quantile(cpu, 0.5));
    add("stddev", "time", deviationOf(real), deviationOf(cpu));
    add("cv", "percentage", ratio(deviationOf(real), meanOf(real)), ratio(deviationOf(cpu), meanOf(cpu)));
}

[[noreturn]] void refuseEntry(const std::string& path, std::size_t index) {
    throw Error(
        path + ": benchmark " + std::to_string(index),
        "this entry is not a run",
        R"({"name": text, "p50": number, ...})",
        "something else");
}

bool isNumber(const Json& entry, const std::string& key) {
    return entry.contains(key) && entry[key].is_number();
}

std::vector<double> numbersIn(const Json& entry, const std::string& key) {
    std::vector<double> values;
    if (!entry.contains(key) || !entry[key].is_array()) return values;
    for (const Json& value : entry[key])
        if (value.is_number()) values.push_back(value.get<double>());
    return values;
}

std::uint64_t countIn(const Json& entry, const std::string& key) {
    return isNumber(entry, key) ? static_cast<std::uint64_t>(std::clamp(entry[key].get<double>(), 0.0, 1e15)) : 0;
}

/// Adds the counters of `entry` to the groups of `run` by their prefixes.
void readCounters(const Json& entry, RunRecord& run) {
    for (const auto& [key, value] : entry.items()) {
        if (!value.is_number()) continue;
        const auto after = [&text = key](const char* prefix) { return text.substr(std::string(prefix).size()); };
        if (key.starts_with(kWork)) run.work[after(kWork)] = value.get<double>();
        if (key.starts_with(kErrors)) run.errors[after(kErrors)] = value.get<double>();
        if (key.starts_with(kProcess)) run.process[after(kProcess)].push_back(value.get<double>());
    }
}

/// Adds the repetition `entry` to `set`. An entry without the times of its frames has one time, its median.
void readEntry(const Json& entry, std::size_t index, ResultSet& set) {
    const bool isRun = entry.is_object() && entry.contains("name") && entry["name"].is_string();
    if (!isRun) refuseEntry(set.path, index);
    if (entry.contains("run_type") && entry["run_type"] == "aggregate") return;
    if (!isNumber(entry, "p50")) refuseEntry(set.path, index);
    RunRecord run;
    run.name = entry["name"].get<std::string>();
    const bool hasLabel = entry.contains("label") && entry["label"].is_string();
    run.label = hasLabel ? entry["label"].get<std::string>() : run.name;
    set.hasOnlyTimes = set.hasOnlyTimes || !entry.contains("repetition_index");
    std::vector<double> real = numbersIn(entry, "frame_ms");
    if (real.empty()) real.push_back(entry["p50"].get<double>());
    std::vector<double> cpu = numbersIn(entry, "frame_cpu_ms");
    if (cpu.empty() && isNumber(entry, "cpu_time")) cpu.push_back(entry["cpu_time"].get<double>());
    run.realMs.push_back(std::move(real));
    if (!cpu.empty()) run.cpuMs.push_back(std::move(cpu));
    run.pagesDamaged = countIn(entry, "pages_damaged");
    run.pagesMissing = countIn(entry, "pages_missing");
    readCounters(entry, run);
    ResultSet more;
    more.runs.push_back(std::move(run));
    append(set, more);
}

} // namespace

std::string resultJson(const ResultSet& set) {
    Json document{{"context", set.context}, {"benchmarks", Json::array()}};
    const auto stated = set.context.find("threads");
    const int threads = stated == set.context.end() ? 1 : std::atoi(stated->second.c_str());
    // Google's tools expect these two as a number and as text.
    if (const auto cpus = set.context.find("num_cpus"); cpus != set.context.end())
        document["context"]["num_cpus"] = std::atoi(cpus->second.c_str());
    document["context"]["caches"] = Json::array();
    for (const RunRecord& run : set.runs) {
        for (std::size_t repetition = 0; repetition < run.realMs.size(); ++repetition)
            document["benchmarks"].push_back(repetitionEntry(run, repetition, threads));
        if (run.realMs.size() > 1) addAggregates(document["benchmarks"], run, threads);
    }
    return telemetry::jsonText(document, 2) + "\n";
}

ResultSet readResultSet(const std::string& path) {
    const Json document = readJsonFile(path);
    const auto part = [&](const char* key) {
        return document.is_object() && document.contains(key) ? document[key] : Json();
    };
    ResultSet set;
    set.path = path;
    const Json context = part("context");
    const Json benchmarks = part("benchmarks");
    if (!context.is_object() || !benchmarks.is_array())
        throw Error(
            path, "this file is not a bench result", R"({"context": {...}, "benchmarks": [...]})", "something else");
    for (const auto& [key, value] : context.items()) {
        if (value.is_string()) set.context[key] = value.get<std::string>();
        if (value.is_number_integer()) set.context[key] = std::to_string(value.get<std::int64_t>());
    }
    for (std::size_t index = 0; index < benchmarks.size(); ++index)
        readEntry(benchmarks[index], index, set);
    return set;
}

} // namespace gnomon::bench
