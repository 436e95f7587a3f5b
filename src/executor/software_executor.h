// The executor that draws without OpenGL: the project's own rasteriser, and shading of what is visible.
#pragma once

#include "executor/executor.h"

#include <memory>

namespace gnomon::executor {

/// Draws the frames that the GL executor draws, on the CPU's cores. The picture does not depend on their number.
std::unique_ptr<Executor> makeSoftwareExecutor();

} // namespace gnomon::executor
