#include "app/interruption.h"

#include "app/console.h"
#include "core/temporary_name.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <unistd.h>

namespace gnomon::app {

namespace {

// A signal reaches nothing else.
constinit std::atomic_flag interrupted;          // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
constinit std::atomic<int> polling{0};           // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
constinit std::atomic<bool> isOnlyNoting{false}; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void onSignal(int /*signal*/) {
    if ((!interrupted.test_and_set() && polling > 0) || isOnlyNoting) return;
    for (const char* text : {"gnomon: ", kInterrupted, "\n"})
        static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text)));
    TemporaryName::removeAllAndExit(1);
}

/// Says what no thread has caught and ends the process, unless that is a fault of the program.
[[noreturn]] void onTerminate() {
    try {
        if (const std::exception_ptr uncaught = std::current_exception()) std::rethrow_exception(uncaught);
    } catch (const std::bad_alloc&) {
        printMessage("out of memory");
        TemporaryName::removeAllAndExit(1);
    } catch (const std::system_error& error) {
        printMessage(std::string("the system refuses: ") + error.what());
        TemporaryName::removeAllAndExit(1);
    } catch (const std::exception& error) {
        printMessage(std::string("ended by ") + error.what());
    } catch (...) {
        printMessage("ended by what no one has caught");
    }
    std::abort();
}

} // namespace

void catchSignals() {
    struct sigaction action {};

    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE})
        ::sigaddset(&action.sa_mask, signal);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        struct sigaction before {};

        const bool isIgnored = ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
        if (isIgnored && (signal == SIGHUP || signal == SIGPIPE)) continue; // nohup, or a shell that wants EPIPE
        ::sigaction(signal, &action, nullptr);
    }
}

void endCleanlyOnSignals() {
    std::set_terminate(onTerminate);
    std::atexit(TemporaryName::removeAll); // where a library ends the program: Xlib, when its server is gone
    std::signal(SIGXFSZ, SIG_IGN);         // a write beyond the limit fails instead
    catchSignals();
}

void onlyNoteSignals() {
    isOnlyNoting = true;
    endCleanlyOnSignals();
}

bool isInterrupted() {
    return interrupted.test();
}

PolledInterruption::PolledInterruption() {
    ++polling;
}

PolledInterruption::~PolledInterruption() {
    --polling;
}

} // namespace gnomon::app
