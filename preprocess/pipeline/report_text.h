// What `gnomon build` says of a build, for people.
#pragma once

#include "preprocess/pipeline/build_model.h"

#include <string>

namespace gnomon::pipeline {

/// `report` of a build from `source` by a process of this peak resident size, in bytes; lines, each with its end.
std::string reportText(const BuildReport& report, const read::MeshSummary& source, std::uint64_t peakResidentBytes);

/// What is wrong where a model does not get coarse enough to be drawn from far away; empty if nothing is.
std::string warningOfCoarsest(const BuildReport& report);

/// Returns how many triangles lie beyond the grid's range and where; empty if none does.
std::string warningOfStrays(const BuildReport& report);

/// Returns what is wrong with a grid whose step is more than a tenth of the median edge; empty if it is finer.
std::string warningOfStep(const BuildReport& report);

} // namespace gnomon::pipeline
