// Writes the report of a build as JSON, for `gnomon build --json`.
#pragma once

#include "preprocess/pipeline/build_model.h"

#include <nlohmann/json_fwd.hpp>

namespace gnomon::pipeline {

/// Returns the report of a build as JSON. `source` describes the source of the build. `peakResidentBytes` is the peak
/// resident memory of the process.
nlohmann::ordered_json reportJson(
    const BuildReport& report, const read::MeshSummary& source, std::uint64_t peakResidentBytes);

} // namespace gnomon::pipeline
