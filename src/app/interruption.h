// The reaction of all commands to the signals INT, TERM, HUP and PIPE.
#pragma once

namespace gnomon::app {

/// The message of an interrupted command.
constexpr const char* kInterrupted = "interrupted; nothing was left half-written";

/// Installs a handler for the four signals. It prints kInterrupted, removes all temporary files and ends the process
/// with exit code 1. HUP and PIPE stay ignored if the parent process ignores them. The function can run before any
/// library is initialised.
void catchSignals();

/// Calls `catchSignals`. In addition, exceptions that no code catches end the process with a message. If the cause is a
/// lack of memory or threads, the process removes its temporary files and its exit code is 1. Otherwise it aborts.
void endCleanlyOnSignals();

/// Calls `endCleanlyOnSignals`, but all signals only set the flag of `isInterrupted`. Use this in a process of an MPI
/// job if another process prints the messages.
void onlyNoteSignals();

/// Returns true if the process received one of the signals.
bool isInterrupted();

/// While an object of this class exists, the first signal only sets the flag of `isInterrupted`. The work must call
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
