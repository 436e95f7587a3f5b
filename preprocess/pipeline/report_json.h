// What `gnomon build --json` prints.
#pragma once

#include "preprocess/pipeline/build_model.h"

#include <nlohmann/json_fwd.hpp>

namespace gnomon::pipeline {

/// `report` of a build from `source` by a process of this peak resident size, in bytes.
nlohmann::ordered_json reportJson(
    const BuildReport& report, const read::MeshSummary& source, std::uint64_t peakResidentBytes);

} // namespace gnomon::pipeline
