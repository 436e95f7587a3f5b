// A child process: its output, processor time and peak memory.
#pragma once

#include <string>
#include <vector>

namespace gnomon::bench {

/// The result of a process that ended.
struct ChildResult {
    int exitCode = 0;   // 128 plus the signal if a signal ended the process
    std::string output; // its standard output
    double wallSeconds = 0;
    double cpuSeconds = 0; // of all its threads
    double peakBytes = 0;  // max resident size
};

/// Runs `words`, a program and its arguments, and waits for its end. Its error messages go to those of this process.
/// Throws Error if the program cannot be started.
ChildResult runChild(const std::vector<std::string>& words);

/// Returns the path of the program of this process.
std::string ownProgram();

} // namespace gnomon::bench
