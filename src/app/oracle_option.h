// --oracle, an option of render and bench.
#pragma once

#include "app/commands.h"
#include "validation/oracle.h"

namespace gnomon::app {

/// Adds `--oracle` to `command`: the ground truth that shadows are compared with. `oracle` must outlive the parsing.
void addOracleOption(CLI::App& command, validation::Oracle& oracle);

} // namespace gnomon::app
