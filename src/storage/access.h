// How servers are asked, and what of their answers is kept.
#pragma once

#include "core/units.h"

#include <chrono>
#include <string>

namespace gnomon::storage {

struct Access {
    std::string authorityFile{};                // certificates that a server's is signed by, PEM; empty: the system's
    Bytes cache = gibibytes(1);                 // of what was read, on this machine's disk; 0: none
    std::string cacheFolder{};                  // empty: XDG_CACHE_HOME/gnomon/ranges, or ~/.cache/gnomon/ranges
    std::chrono::milliseconds patience{30'000}; // how long a server that says nothing is asked again
};

/// That of the whole process: what its command line says, before anything is opened.
Access& commonAccess();

} // namespace gnomon::storage
