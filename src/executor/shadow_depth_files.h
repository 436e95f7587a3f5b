// Export of the shadow maps of a frame as files.
#pragma once

#include "executor/executor.h"

#include <string>

namespace gnomon::executor {

/// Writes each map of `plan` as a PFM into `folder`, named by slice and face. `executor` must have drawn the plan just
/// before. Throws Error if that fails.
void writeShadowMaps(const std::string& folder, const plan::FramePlan& plan, Executor& executor);

} // namespace gnomon::executor
