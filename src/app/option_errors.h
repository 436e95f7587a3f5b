// Errors about limits, in the words of the command line.
#pragma once

#include "core/limit_error.h"

namespace gnomon::app {

/// Returns `error` with the option that sets its limit.
Error inOptions(const LimitError& error);

/// Returns what `work` returns; a LimitError out of it names the option.
template <class Work>
auto withOptionErrors(const Work& work) {
    try {
        return work();
    } catch (const LimitError& error) {
        throw inOptions(error);
    }
}

} // namespace gnomon::app
