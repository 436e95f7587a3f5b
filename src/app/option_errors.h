// Errors about limits, with the options of the command line that set them.
#pragma once

#include "core/limit_error.h"

namespace gnomon::app {

/// Returns `error` with the names of the options that set its limits, such as --memory.
Error inOptions(const LimitError& error);

} // namespace gnomon::app
