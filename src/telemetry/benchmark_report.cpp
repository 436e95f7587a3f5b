#include "telemetry/benchmark_report.h"

#include "core/check.h"
#include "core/formatted.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>
#include <vector>

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

/// Returns the first line of a file, or "unknown".
std::string firstLine(const char* path) {
    std::ifstream file(path);
    std::string line;
    return std::getline(file, line) && !line.empty() ? line : "unknown";
}

/// Returns the width of the widest vector instructions of this processor, in bits.
int simdBits() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") != 0) return 512;
    return __builtin_cpu_supports("avx2") != 0 ? 256 : 128;
#else
    return 128;
#endif
}

/// Returns the number of waiting and running threads of the machine, mean over one minute.
std::string loadAverage() {
    std::array<double, 1> load{};
    if (::getloadavg(load.data(), 1) != 1) return "unknown";
    return formatted("%.2f", load[0]);
}

std::string environmentOr(const char* name, const std::string& otherwise) {
    const char* const text = std::getenv(name);
    return text == nullptr || *text == 0 ? otherwise : text;
}

} // namespace

double stolenSeconds() {
    std::ifstream file("/proc/stat");
    std::string word;
    file >> word; // "cpu"
    double ticks = 0;
    for (int field = 0; field < 8; ++field) // user, nice, system, idle, iowait, irq, softirq, steal
        if (!(file >> ticks)) return 0;
    return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

std::map<std::string, std::string> machineContext() {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 32> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    const auto pageBytes = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t memory = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * pageBytes;
    const std::string hostClass = formatted(
        "%u x %s, %.0f GiB",
        std::thread::hardware_concurrency(),
        processorName().c_str(),
        std::round(static_cast<double>(memory) * 0x1p-30));
#ifdef __clang__
    const char* const compiler = __VERSION__; // already begins with "Clang"
#else
    const std::string compiler = "GCC " __VERSION__;
#endif
    return {
        {"date", date.data()},
        {"host_name", host.data()},
        {"cpu", processorName()},
        {"memory_bytes", std::to_string(memory)},
        {"compiler", compiler},
        {"num_cpus", std::to_string(std::thread::hardware_concurrency())},
        {"host_class", hostClass},
        {"load", loadAverage()},
        {"governor", firstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")},
        {"simd_bits", std::to_string(simdBits())},
        {"commit", environmentOr("GNOMON_COMMIT", environmentOr("GITHUB_SHA", "unknown"))},
#ifdef NDEBUG
        {"library_build_type", "release"},
#else
        {"library_build_type", "debug"},
#endif
    };
}

} // namespace gnomon::telemetry
