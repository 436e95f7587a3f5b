#include "app/console.h"

#include "core/error.h"
#include "core/printable.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <fcntl.h>
#include <unistd.h>

namespace gnomon::app {

void occupyStandardDescriptors() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
        // open() returns the lowest free descriptor, which is the missing one. It is opened for the opposite direction
        // (stdin for writing), so that its use is still an error.
        static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY)); // NOLINT: inherited
    }
}

void printMessage(const std::string& text) {
    std::fprintf(stderr, "gnomon: %s\n", printable(text).c_str());
}

void printWarning(const std::string& text) {
    printMessage("warning: " + text);
}

void requirePrinted(const std::string& kept) {
    const auto fail = [&](const std::string& why) {
        throw Error("stdout", "cannot write: " + why + (kept.empty() ? "" : "; " + kept + ", but its summary is lost"));
    };
    std::cout.flush(); // contains the output of --help and --version
    if (std::fflush(stdout) != 0) fail(std::strerror(errno));
    if (!std::cout.good() || std::ferror(stdout) != 0) fail("some of the output is lost");
}

} // namespace gnomon::app
