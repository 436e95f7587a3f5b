// Runs a program with subcommands, and converts errors to exit codes.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace gnomon::app {

/// The name and the subcommands of a command-line program.
struct Program {
    const char* name;
    const char* description;
    std::vector<std::function<void(CLI::App&)>> commands; // each adds one subcommand, in the order of --help
    bool isSilent = false;                                // true: another process prints help and version
};

/// Failed gates of `gnomon bench`, with the exit code 3, 4 or 5.
class GatesFailed : public std::runtime_error {
public:
    GatesFailed(int exitCode, const std::string& what) : std::runtime_error(what), exitCode_(exitCode) {}

    int exitCode() const { return exitCode_; }

private:
    int exitCode_;
};

/// Parses the command line and runs the subcommand that the user chose. Throws UsageError and the exceptions of the
/// subcommand.
void runProgram(const Program& about, int argc, char** argv);

/// Runs `work` and returns the exit code of the program: 0 for success, 2 for a UsageError, the code of GatesFailed,
/// and 1 for all other exceptions. Prints the message of an exception to stderr, in one line.
int exitCodeOf(const std::function<void()>& work);

} // namespace gnomon::app
