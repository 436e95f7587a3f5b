// Checks against a bad programmer: they print both values and abort. A bad world throws gnomon::Error instead.
#pragma once

#include <sstream>
#include <string>

namespace gnomon::detail {

/// Prints `message` with its place and aborts.
[[noreturn]] void checkFailed(const char* file, int line, const std::string& message);

template <class A, class B>
std::string comparison(const char* expression, const A& a, const B& b) {
    std::ostringstream text;
    text << expression << " (" << a << " against " << b << ")";
    return text.str();
}

} // namespace gnomon::detail

/// Aborts with the expression when it is false.
#define GNOMON_CHECK(condition)                                                                                        \
    do {                                                                                                               \
        if (!(condition)) ::gnomon::detail::checkFailed(__FILE__, __LINE__, #condition);                               \
    } while (false)

/// Aborts with both values unless `a OP b`.
#define GNOMON_CHECK_OP(a, OP, b)                                                                                      \
    do {                                                                                                               \
        const auto& gnomonA = (a);                                                                                     \
        const auto& gnomonB = (b);                                                                                     \
        if (!(gnomonA OP gnomonB))                                                                                     \
            ::gnomon::detail::checkFailed(                                                                             \
                __FILE__, __LINE__, ::gnomon::detail::comparison(#a " " #OP " " #b, gnomonA, gnomonB));                \
    } while (false)
