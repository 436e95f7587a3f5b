// The text report of `gnomon build`.
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

/// Returns a warning if the coarsest level is too fine to be drawn from far away, or an empty text.
std::string warningOfCoarsest(const BuildReport& report);

/// Returns the number and the bounds of the triangles outside the grid's range, or an empty text if there are none.
std::string warningOfStrays(const BuildReport& report);

/// Returns a warning if the grid step exceeds a tenth of the median edge, or an empty text.
std::string warningOfStep(const BuildReport& report);

} // namespace gnomon::pipeline
