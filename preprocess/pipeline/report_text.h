// What `gnomon build` says of a build, for people.
#pragma once

#include "preprocess/pipeline/build_model.h"

#include <cstdint>
#include <map>
#include <string>

namespace gnomon::pipeline {

/// Returns the data of the source that the model does not keep, and how often each kind of data occurs.
std::map<std::string, std::uint64_t> attributesDropped(const BuildReport& report, const read::MeshSummary& source);

/// `report` of a build from `source` by a process of this peak resident size, in bytes; lines, each with its end.
/// `howToTurn` says how the caller turns a model; it follows the up axis, unless the source or the caller told the
/// axis.
std::string reportText(
    const BuildReport& report,
    const read::MeshSummary& source,
    std::uint64_t peakResidentBytes,
    const std::string& howToTurn);

/// What is wrong where a model does not get coarse enough to be drawn from far away; empty if nothing is.
std::string warningOfCoarsest(const BuildReport& report);

/// Returns how many triangles lie beyond the grid's range and where; empty if none does.
std::string warningOfStrays(const BuildReport& report);

/// Returns what is wrong with a grid whose step is more than a tenth of the median edge; empty if it is finer.
std::string warningOfStep(const BuildReport& report);

} // namespace gnomon::pipeline
