// printf into a string.
#pragma once

#include <string>

namespace gnomon {

/// What printf would write, of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

} // namespace gnomon
