// The exception for damaged temporary data of a build.
#pragma once

#include "core/error.h"

namespace gnomon::scratch {

/// The exception that temporary data are missing, truncated or changed. A resumed build then starts from the beginning.
class DamageError : public Error {
public:
    using Error::Error;
};

} // namespace gnomon::scratch
