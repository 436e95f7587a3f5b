// Preloaded into the program: each frame of a bench sleeps, or the process needs more memory, in one program only.
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include <dlfcn.h>
#include <unistd.h>

namespace {

long numberFrom(const char* variable, long otherwise) {
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::atol(text);
}

/// Whether this process runs the program $SLOW_PROGRAM.
bool isSlowProgram() {
    char name[4096] = {};
    const char* wanted = std::getenv("SLOW_PROGRAM");
    return wanted != nullptr && readlink("/proc/self/exe", name, sizeof name - 1) > 0 && std::strcmp(name, wanted) == 0;
}

void sleepFor(long microseconds) {
    const std::timespec time{microseconds / 1000000, microseconds % 1000000 * 1000};
    nanosleep(&time, nullptr);
}

} // namespace

/// Sleeps $SLOW_MICROSECONDS in each $SLOW_EVERYth frame. A bench reads the processor time before each frame. The next
/// reading of the monotonic clock is the start of the frame, and the one after it lies within the frame.
// NOLINTNEXTLINE(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)
extern "C" int clock_gettime(clockid_t clock, std::timespec* time) noexcept {
    using Clock = int (*)(clockid_t, std::timespec*);
    static const auto real = reinterpret_cast<Clock>(dlsym(RTLD_NEXT, "clock_gettime"));
    static const bool isSlow = isSlowProgram();
    static const long microseconds = numberFrom("SLOW_MICROSECONDS", 0);
    static const long every = numberFrom("SLOW_EVERY", 1);
    static std::atomic<long> readings{0}; // of the processor time
    static std::atomic<int> since{2};     // readings of the monotonic clock after it
    if (isSlow && microseconds > 0 && clock == CLOCK_PROCESS_CPUTIME_ID) {
        since = readings++ / 2 % every == 0 && readings % 2 == 1 ? 0 : 2;
    } else if (isSlow && clock == CLOCK_MONOTONIC && since < 2 && ++since == 2) {
        sleepFor(microseconds);
    }
    return real(clock, time);
}

/// Touches $SLOW_BYTES of memory before `main`, and keeps them.
__attribute__((constructor)) static void needMemory() {
    const long bytes = numberFrom("SLOW_BYTES", 0);
    if (bytes <= 0 || !isSlowProgram()) return;
    auto* const memory = static_cast<char*>(std::malloc(static_cast<std::size_t>(bytes)));
    if (memory == nullptr) return;
    for (long i = 0; i < bytes; i += 4096)
        static_cast<volatile char*>(memory)[i] = 1;
}
