// Formats values into a std::string with a printf format.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace gnomon {

/// Returns the text that printf would write for these arguments. The length has no limit.
[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    std::va_list again;
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, format, arguments);
    va_end(arguments);
    std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, ' ');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    return text;
}

} // namespace gnomon
