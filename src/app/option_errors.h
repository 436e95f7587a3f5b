// Adds the names of command-line options to errors about limits.
#pragma once

#include "core/limit_error.h"

namespace gnomon::app {

/// Returns `error` with the names of the options that set its limits, such as --memory, so that the user can change
/// them.
Error inOptions(const LimitError& error);

} // namespace gnomon::app
