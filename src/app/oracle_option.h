// The option --oracle of the commands render and bench, which compares shadows with the ground truth.
#pragma once

#include "app/commands.h"
#include "validation/ground_truth_kind.h"

namespace gnomon::app {

/// Adds the option `--oracle` to `command`. It selects the ground truth with which shadows are compared. `groundTruth`
/// must exist until the command line is parsed.
void addOracleOption(CLI::App& command, validation::GroundTruth& groundTruth);

} // namespace gnomon::app
