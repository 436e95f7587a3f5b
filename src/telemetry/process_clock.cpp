#include "telemetry/process_clock.h"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace gnomon::telemetry {

namespace {

Milliseconds now(clockid_t clock) {
    std::timespec time{};
    ::clock_gettime(clock, &time);
    return {static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6};
}

/// Returns when the process started, as time since boot (proc(5), /proc/self/stat, field 22). Without /proc, returns
/// the time of the first call.
Milliseconds processStart() {
    std::ifstream file("/proc/self/stat");
    std::string text;
    std::getline(file, text);
    const std::size_t nameEnd = text.rfind(')'); // the second field can contain spaces and parentheses
    if (nameEnd == std::string::npos) return now(CLOCK_BOOTTIME);
    std::istringstream fields(text.substr(nameEnd + 1));
    constexpr int kFieldsBefore = 19; // the fields 3 to 21
    std::string skipped;
    for (int i = 0; i < kFieldsBefore; ++i)
        fields >> skipped;
    double ticks = 0;
    fields >> ticks;
    return {ticks * 1e3 / static_cast<double>(::sysconf(_SC_CLK_TCK))};
}

} // namespace

Milliseconds sinceProcessStart() {
    static const Milliseconds start = processStart();
    return {now(CLOCK_BOOTTIME).count - start.count};
}

Milliseconds processorTime() {
    return now(CLOCK_PROCESS_CPUTIME_ID);
}

Bytes peakResident() {
    // The peak memory of getrusage can include the memory of the parent process at the start of this process. VmHWM
    // does not include it.
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        constexpr std::string_view kName = "VmHWM:";
        if (line.starts_with(kName)) return {std::strtoull(line.c_str() + kName.size(), nullptr, 10) << 10U};
    }
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return {static_cast<std::uint64_t>(usage.ru_maxrss) << 10U};
}

} // namespace gnomon::telemetry
