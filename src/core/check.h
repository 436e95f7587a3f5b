// Assertions against programming errors. A failed check prints the compared values and aborts. Errors of files, OpenGL
// or input are not checked here, but throw gnomon::Error.
#pragma once

#include <sstream>
#include <string>

namespace gnomon::detail {

/// Prints `message` with the file and line of a failed check, and aborts the process.
[[noreturn]] void checkFailed(const char* file, int line, const std::string& message);

template <class A, class B>
std::string comparison(const char* expression, const A& a, const B& b) {
    std::ostringstream text;
    text << expression << " (" << a << " against " << b << ")";
    return text.str();
}

} // namespace gnomon::detail

/// Aborts the process if `condition` is false, and prints the expression.
#define GNOMON_CHECK(condition)                                                                                        \
    do {                                                                                                               \
        if (!(condition)) ::gnomon::detail::checkFailed(__FILE__, __LINE__, #condition);                               \
    } while (false)

/// Aborts the process if `a OP b` is false, and prints both values.
#define GNOMON_CHECK_OP(a, OP, b)                                                                                      \
    do {                                                                                                               \
        const auto& gnomonA = (a);                                                                                     \
        const auto& gnomonB = (b);                                                                                     \
        if (!(gnomonA OP gnomonB))                                                                                     \
            ::gnomon::detail::checkFailed(                                                                             \
                __FILE__, __LINE__, ::gnomon::detail::comparison(#a " " #OP " " #b, gnomonA, gnomonB));                \
    } while (false)
