// --oracle, an option of render and bench.
#pragma once

#include "app/commands.h"
#include "validation/ground_truth_kind.h"

namespace gnomon::app {

/// Adds `--groundTruth` to `command`: the ground truth that shadows are compared with. `groundTruth` must outlive the
/// parsing.
void addOracleOption(CLI::App& command, validation::GroundTruth& groundTruth);

} // namespace gnomon::app
