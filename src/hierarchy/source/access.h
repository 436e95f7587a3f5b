// Settings for reading models from web servers: certificates, cache and timeouts.
#pragma once

#include "core/units.h"

#include <chrono>
#include <string>

namespace gnomon::hierarchy {

struct Access {
    std::string authorityFile{}; // PEM file of certificate authorities; empty: those of the system
    Bytes cache = gibibytes(1);  // max size of the cache on the local disk; 0: no cache
    // Folder of the cache for web servers. If it is empty, it is XDG_CACHE_HOME/gnomon/ranges, or
    // ~/.cache/gnomon/ranges.
    std::string cacheFolder{};
    std::chrono::milliseconds retryTime{30'000}; // max time of retries while a server does not respond
};

/// Returns the server settings of the whole process. The command line changes them before a model is opened.
Access& commonAccess();

} // namespace gnomon::hierarchy
