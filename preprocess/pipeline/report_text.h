// Writes the report of a build as text, for `gnomon build`.
#pragma once

#include "preprocess/pipeline/build_model.h"

#include <cstdint>
#include <map>
#include <string>

namespace gnomon::pipeline {

/// Returns the kinds of source data that the model does not store, with the number of their occurrences in the source.
std::map<std::string, std::uint64_t> attributesDropped(const BuildReport& report, const read::MeshSummary& source);

/// Returns the report of a build as text, one fact per line. `source` describes the source of the build.
/// `peakResidentBytes` is the peak resident memory of the process. `howToTurn` is a hint how the user can turn the
/// model. The hint follows the up axis unless the source or the user named the axis.
std::string reportText(
    const BuildReport& report,
    const read::MeshSummary& source,
    std::uint64_t peakResidentBytes,
    const std::string& howToTurn);

/// Returns a warning if the coarsest level has too many triangles for a distant view. Otherwise returns an empty text.
std::string warningOfCoarsest(const BuildReport& report);

/// Returns a warning with the number and the bounds of the triangles outside the range of the grid. Returns an empty
/// text if there are no such triangles.
std::string warningOfStrays(const BuildReport& report);

/// Returns a warning if the step of the position grid exceeds a tenth of the median edge length. Otherwise returns an
/// empty text.
std::string warningOfStep(const BuildReport& report);

} // namespace gnomon::pipeline
