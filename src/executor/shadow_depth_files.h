// The shadow maps of a frame as files, for whoever wants to look at them.
#pragma once

#include "executor/executor.h"

#include <string>

namespace gnomon::executor {

/// Writes each map of `plan`, which `executor` has just drawn, into `folder` as a PFM of its own, named by its slice
/// and face. Throws Error.
void writeShadowMaps(const std::string& folder, const plan::FramePlan& plan, Executor& executor);

} // namespace gnomon::executor
