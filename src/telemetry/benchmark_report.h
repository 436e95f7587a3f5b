// Writes the summary of `gnomon bench` in the JSON format of Google Benchmark, so that its tools can read it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::telemetry {

/// The frame times of one run of `gnomon bench`: one combination of settings with all repetitions.
struct RunTimes {
    std::string name;
    std::vector<double> totalMs;
    double cpuMs = 0;               // sum over all threads, mean per frame
    std::uint64_t pagesDamaged = 0; // total up to the last frame
    std::uint64_t pagesMissing = 0; // max over all frames
};

/// Returns the quantile of `values` at `fraction` in [0, 1], with linear interpolation between ranks. `values` must not
/// be empty.
double quantile(std::span<const double> values, double fraction);

/// Returns the summary of all runs as JSON: `context` (machine and settings) and `benchmarks` (one entry per run). An
/// entry contains `name`, `iterations`, the means `real_time` and `cpu_time`, `time_unit`, and the percentiles `p50`,
/// `p95` and `p99` in milliseconds. It also contains `pages_damaged` and `pages_missing`.
std::string benchmarkJson(const std::map<std::string, std::string>& context, std::span<const RunTimes> runs);

/// Returns properties of this machine and build: date, host_name, num_cpus, cpu, memory_bytes, compiler and
/// library_build_type.
std::map<std::string, std::string> machineContext();

} // namespace gnomon::telemetry
