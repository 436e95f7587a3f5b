#include "core/check.h"

#include <cstdio>
#include <cstdlib>

namespace gnomon::detail {

void checkFailed(const char* file, int line, const std::string& message) {
    std::fprintf(stderr, "gnomon: internal check failed at %s:%d: %s\n", file, line, message.c_str());
    std::abort();
}

} // namespace gnomon::detail
