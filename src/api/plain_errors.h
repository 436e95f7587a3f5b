// Converts internal exceptions to std::runtime_error for users of the library.
#pragma once

#include "core/error.h"
#include "settings/usage_error.h"

namespace gnomon::api {

/// Runs `work` and returns its result. Converts UsageError to Error, which is a std::runtime_error.
template <class Work>
auto withPlainErrors(const Work& work) {
    try {
        return work();
    } catch (const settings::UsageError& error) {
        throw Error(error.message);
    }
}

} // namespace gnomon::api
