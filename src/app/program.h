// A program of subcommands, and the one place where errors become exit codes.
#pragma once

#include <functional>
#include <vector>

#include <CLI/CLI.hpp>

namespace gnomon::app {

struct Program {
    const char* name;
    const char* description;
    std::vector<std::function<void(CLI::App&)>> commands; // each adds itself, in the order of --help
    bool isSilent = false;                                // prints neither help nor version: another process does
};

/// Runs what the command line asks for. Throws UsageError and what commands throw.
void runProgram(const Program& about, int argc, char** argv);

/// Runs `work`; what it throws is told in one line.
int exitCodeOf(const std::function<void()>& work);

} // namespace gnomon::app
