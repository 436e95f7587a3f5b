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

// These flags are global, because a signal handler can access only global data.
constinit std::atomic_flag interrupted;          // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
constinit std::atomic<int> polling{0};           // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
constinit std::atomic<bool> isOnlyNoting{false}; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void onSignal(int /*signal*/) {
    if ((!interrupted.test_and_set() && polling > 0) || isOnlyNoting) return;
    for (const char* text : {"gnomon: ", kInterrupted, "\n"})
        static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text)));
    TemporaryName::removeAllAndExit(1);
}

/// Handles an exception that no code has caught, and prints its message. Ends the process with exit code 1 if the cause
/// is a lack of memory or threads. Otherwise the cause is a bug, and the function aborts.
[[noreturn]] void onTerminate() {
    try {
        if (const std::exception_ptr uncaught = std::current_exception()) std::rethrow_exception(uncaught);
    } catch (const std::bad_alloc&) {
        printMessage("out of memory");
        TemporaryName::removeAllAndExit(1);
    } catch (const std::system_error& error) {
        printMessage(std::string("the operating system refused: ") + error.what());
        TemporaryName::removeAllAndExit(1);
    } catch (const std::exception& error) {
        printMessage(std::string("ended by an unexpected error: ") + error.what());
    } catch (...) {
        printMessage("ended by an unexpected error of unknown type");
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
        // The parent process can ignore HUP (nohup) or PIPE (a shell that expects EPIPE). These signals then stay
        // ignored.
        if (isIgnored && (signal == SIGHUP || signal == SIGPIPE)) continue;
        ::sigaction(signal, &action, nullptr);
    }
}

void endCleanlyOnSignals() {
    std::set_terminate(onTerminate);
    std::atexit(TemporaryName::removeAll); // a library can call exit: Xlib does if its server ends
    std::signal(SIGXFSZ, SIG_IGN);         // a write above the file size limit then fails with an error
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
