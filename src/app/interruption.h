// Handles the signals INT, TERM, HUP and PIPE in all commands.
#pragma once

namespace gnomon::app {

/// The message of an interrupted command.
constexpr const char* kInterrupted = "interrupted; nothing was left half-written";

/// Installs a handler for INT, TERM, HUP and PIPE. It prints kInterrupted, removes all temporary files and ends the
/// process with exit code 1. HUP and PIPE stay ignored if the parent process ignores them. The function can run before
/// any library is initialised.
void catchSignals();

/// Installs the signal handler of `catchSignals`. In addition, exceptions that no code catches end the process with a
/// message. If the cause is a lack of memory or threads, the process removes its temporary files and its exit code is
/// 1. Otherwise it aborts.
void endCleanlyOnSignals();

/// Installs handlers like `endCleanlyOnSignals`, but all signals only set the flag of `isInterrupted`. Use this in a
/// process of an MPI job if another process prints the messages.
void onlyNoteSignals();

/// Returns true if the process has received one of the signals INT, TERM, HUP and PIPE.
bool isInterrupted();

/// While an object of this class exists, the first signal only sets the flag of `isInterrupted`. The command must call
/// `isInterrupted` often and stop by itself. A second signal ends the process.
class PolledInterruption {
public:
    PolledInterruption();
    ~PolledInterruption();
    PolledInterruption(const PolledInterruption&) = delete;
    PolledInterruption& operator=(const PolledInterruption&) = delete;
    PolledInterruption(PolledInterruption&&) = delete;
    PolledInterruption& operator=(PolledInterruption&&) = delete;
};

} // namespace gnomon::app
