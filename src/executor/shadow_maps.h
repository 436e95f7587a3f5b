// The shadow maps of a frame as pictures.
#pragma once

#include "executor/executor.h"

#include <string>
#include <vector>

namespace gnomon::executor {

/// A picture of depths, and the file that it is for.
struct NamedDepths {
    std::string path;
    FloatPicture depths;
};

/// Returns each map of `plan`, which `executor` has just drawn. The name of its file is made of its slice and face.
std::vector<NamedDepths> shadowMaps(const plan::FramePlan& plan, Executor& executor);

} // namespace gnomon::executor
