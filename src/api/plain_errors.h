// What who uses the library has to catch.
#pragma once

#include "core/error.h"
#include "settings/usage_error.h"

namespace gnomon::api {

/// What `work` returns; contradictions in options become an Error, which is a std::runtime_error like all others.
template <class Work>
auto withPlainErrors(const Work& work) {
    try {
        return work();
    } catch (const settings::UsageError& error) {
        throw Error(error.message);
    }
}

} // namespace gnomon::api
