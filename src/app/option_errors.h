// Errors about limits, in the words of the command line.
#pragma once

#include "core/limit_error.h"

namespace gnomon::app {

/// Returns `error` with the option that sets its limit.
Error inOptions(const LimitError& error);

} // namespace gnomon::app
