#include "telemetry/benchmark_report.h"

#include "core/check.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <numeric>
#include <thread>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gnomon::telemetry {

double quantile(std::span<const double> values, double fraction) {
    GNOMON_CHECK(!values.empty());
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double rank = fraction * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

std::string benchmarkJson(const std::map<std::string, std::string>& context, std::span<const RunTimes> runs) {
    nlohmann::ordered_json document;
    document["context"] = context;
    document["benchmarks"] = nlohmann::ordered_json::array();
    for (const RunTimes& run : runs) {
        const double sum = std::accumulate(run.totalMs.begin(), run.totalMs.end(), 0.0);
        const double mean = sum / static_cast<double>(run.totalMs.size());
        document["benchmarks"].push_back(
            {{"name", run.name},
             {"run_name", run.name},
             {"run_type", "iteration"},
             {"iterations", run.totalMs.size()},
             {"real_time", mean},
             {"cpu_time", run.cpuMs},
             {"time_unit", "ms"},
             {"p50", quantile(run.totalMs, 0.50)},
             {"p95", quantile(run.totalMs, 0.95)},
             {"p99", quantile(run.totalMs, 0.99)},
             {"pages_damaged", run.pagesDamaged},
             {"pages_missing", run.pagesMissing}});
    }
    return jsonText(document, 2);
}

namespace {

/// Returns the name of the first processor of this machine from /proc/cpuinfo, or "unknown".
std::string processorName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

} // namespace

std::map<std::string, std::string> machineContext() {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 32> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    const auto pageBytes = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
#ifdef __clang__
    const char* const compiler = __VERSION__; // already begins with "Clang"
#else
    const std::string compiler = "GCC " __VERSION__;
#endif
    return {
        {"date", date.data()},
        {"host_name", host.data()},
        {"cpu", processorName()},
        {"memory_bytes", std::to_string(static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * pageBytes)},
        {"compiler", compiler},
        {"num_cpus", std::to_string(std::thread::hardware_concurrency())},
#ifdef NDEBUG
        {"library_build_type", "release"},
#else
        {"library_build_type", "debug"},
#endif
    };
}

} // namespace gnomon::telemetry
