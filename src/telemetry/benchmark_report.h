// The summary of a bench in the shape of Google Benchmark's JSON, so that its tools read it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::telemetry {

/// The frame times of one run (one combination of settings, all repetitions).
struct RunTimes {
    std::string name;
    std::vector<double> totalMs;
    double cpuMs = 0;               // of all threads, a frame on average
    std::uint64_t pagesDamaged = 0; // by its last frame
    std::uint64_t pagesMissing = 0; // in the frame that lacked most
};

/// The `fraction` quantile of `values`, linear between ranks; `fraction` in [0, 1], at least one value.
double quantile(std::span<const double> values, double fraction);

/// `context` (what was measured and where) and `benchmarks`: one entry a run with `name`, `iterations`, `real_time`
/// (the mean), `cpu_time` (the mean), `time_unit`, `p50`, `p95` and `p99`, in milliseconds, `pages_damaged` and
/// `pages_missing`.
std::string benchmarkJson(const std::map<std::string, std::string>& context, std::span<const RunTimes> runs);

/// The facts of this machine and build that every context has: date, host_name, num_cpus, cpu, memory_bytes, compiler,
/// library_build_type.
std::map<std::string, std::string> machineContext();

} // namespace gnomon::telemetry
