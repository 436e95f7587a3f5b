// Preloaded into the program: its reads of models from a place on fail, as on a disk that wears out, and so do removals
// of temporary files; or it gets a signal before the libraries are ready.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include <dlfcn.h>
#include <unistd.h>

namespace {

/// Whether `file` is a model.
bool isModel(int file) {
    char name[4096] = {};
    const std::string link = "/proc/self/fd/" + std::to_string(file);
    const ssize_t length = readlink(link.c_str(), name, sizeof name - 1);
    return length > 4 && std::strcmp(name + length - 4, ".gnm") == 0;
}

long numberFrom(const char* variable) {
    const char* text = std::getenv(variable);
    return text == nullptr ? 0 : std::atol(text);
}

} // namespace

/// Fails with EIO for models at $FAIL_FROM up to $FAIL_TO, the first $FAIL_TIMES times.
// NOLINTNEXTLINE(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)
extern "C" ssize_t pread(int file, void* to, size_t count, off_t offset) {
    auto* const real = reinterpret_cast<ssize_t (*)(int, void*, size_t, off_t)>(dlsym(RTLD_NEXT, "pread"));
    static std::atomic<long> left = numberFrom("FAIL_TIMES");
    const bool isThere = offset >= numberFrom("FAIL_FROM") && offset < numberFrom("FAIL_TO");
    if (!isThere || left <= 0 || !isModel(file)) return real(file, to, count, offset);
    --left;
    errno = EIO;
    return -1;
}

namespace {

using Remove = int (*)(const char*);

/// Fails with EIO below folders NAME.building, the first $FAIL_REMOVALS times.
int removed(const char* path, const char* function) {
    static std::atomic<long> left = numberFrom("FAIL_REMOVALS");
    if (std::strstr(path, ".building/") == nullptr || left <= 0)
        return reinterpret_cast<Remove>(dlsym(RTLD_NEXT, function))(path);
    --left;
    errno = EIO;
    return -1;
}

} // namespace

// NOLINTBEGIN(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)
extern "C" int unlink(const char* path) noexcept {
    return removed(path, "unlink");
}

extern "C" int remove(const char* path) noexcept {
    return removed(path, "remove");
}

// NOLINTEND(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)

/// Runs while libraries initialise themselves, before `main`.
__attribute__((constructor)) static void raiseEarly() {
    if (const long signal = numberFrom("RAISE_EARLY"); signal > 0) ::raise(static_cast<int>(signal));
}
