// The error of damaged temporary data.
#pragma once

#include "core/error.h"

namespace gnomon::scratch {

/// The error that temporary data are missing, cut off or changed. A resumed build then starts from the beginning.
class DamageError : public Error {
public:
    using Error::Error;
};

} // namespace gnomon::scratch
