// Errors about limits, with the options of the command line that set them.
#pragma once

#include "core/limit_error.h"

namespace gnomon::app {

/// Returns `error` with the name of the option that sets its limit, such as --memory.
Error inOptions(const LimitError& error);

} // namespace gnomon::app
