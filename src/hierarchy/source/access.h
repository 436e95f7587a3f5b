// Settings for reading from servers: certificates, cache and timeouts.
#pragma once

#include "core/units.h"

#include <chrono>
#include <string>

namespace gnomon::hierarchy {

struct Access {
    std::string authorityFile{};                 // PEM file of certificate authorities; empty: the system's
    Bytes cache = gibibytes(1);                  // max size of the cache on the local disk; 0: no cache
    std::string cacheFolder{};                   // empty: XDG_CACHE_HOME/gnomon/ranges, or ~/.cache/gnomon/ranges
    std::chrono::milliseconds retryTime{30'000}; // time limit of retries for a server that does not respond
};

/// Returns the settings of the whole process, which the command line sets before a model is opened.
Access& commonAccess();

} // namespace gnomon::hierarchy
