// The subcommand `gnomon bench build`.
#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::app {

/// Adds `build` to `bench` and returns it.
CLI::App* addBenchBuildCommand(CLI::App& bench);

} // namespace gnomon::app
