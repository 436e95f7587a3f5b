// How the program ends when a signal asks it to, INT, TERM, HUP or PIPE: all commands in one way.
#pragma once

namespace gnomon::app {

constexpr const char* kInterrupted = "interrupted; nothing was left half-written";

/// From now on such a signal removes every temporary file, says kInterrupted and ends the process with exit code 1. HUP
/// and PIPE stay ignored where they are. The function can run before any library has initialised itself.
void catchSignals();

/// Does that. From now on std::terminate for want of memory or threads ends the process likewise.
void endCleanlyOnSignals();

/// Likewise, but such a signal is only noted, however often it comes: for a process that another one speaks for.
void onlyNoteSignals();

/// Whether one of the signals has come.
bool isInterrupted();

/// While one lives, the first signal is but noted, for work that asks `isInterrupted` often and unwinds.
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
