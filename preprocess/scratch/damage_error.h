// The error of temporary data that differ from the data that were written.
#pragma once

#include "core/error.h"

namespace gnomon::scratch {

/// Temporary data are lost, cut off or changed. A resumed build starts anew.
class DamageError : public Error {
public:
    using Error::Error;
};

} // namespace gnomon::scratch
