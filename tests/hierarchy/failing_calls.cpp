#include "failing_calls.h"

#include <cerrno>

#include <dlfcn.h>
#include <unistd.h>
#include <zstd.h>
#include <zstd_errors.h>

namespace gnomon::tests {

FailingCalls& failingCalls() {
    static FailingCalls calls;
    return calls;
}

namespace {

/// Whether this call is one of those that fail.
bool takeOne(std::atomic<int>& left) {
    if (left.load() <= 0) return false;
    --left;
    return true;
}

/// What the program would have called.
template <class Call>
Call* next(const char* name) {
    return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name));
}

} // namespace

} // namespace gnomon::tests

extern "C" {

// NOLINTBEGIN(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)
ssize_t pread(int file, void* to, size_t count, off_t offset) {
    auto* const real = gnomon::tests::next<ssize_t(int, void*, size_t, off_t)>("pread");
    if (!gnomon::tests::takeOne(gnomon::tests::failingCalls().reads)) return real(file, to, count, offset);
    errno = EIO;
    return -1;
}

ZSTD_CCtx* ZSTD_createCCtx(void) {
    auto* const real = gnomon::tests::next<ZSTD_CCtx*()>("ZSTD_createCCtx");
    return gnomon::tests::takeOne(gnomon::tests::failingCalls().contexts) ? nullptr : real();
}

ZSTD_DCtx* ZSTD_createDCtx(void) {
    auto* const real = gnomon::tests::next<ZSTD_DCtx*()>("ZSTD_createDCtx");
    return gnomon::tests::takeOne(gnomon::tests::failingCalls().contexts) ? nullptr : real();
}

size_t ZSTD_compressStream2(ZSTD_CCtx* context, ZSTD_outBuffer* out, ZSTD_inBuffer* in, ZSTD_EndDirective then) {
    auto* const real = gnomon::tests::next<size_t(ZSTD_CCtx*, ZSTD_outBuffer*, ZSTD_inBuffer*, ZSTD_EndDirective)>(
        "ZSTD_compressStream2");
    if (!gnomon::tests::takeOne(gnomon::tests::failingCalls().compressions)) return real(context, out, in, then);
    return static_cast<size_t>(-ZSTD_error_memory_allocation);
}

// NOLINTEND(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)

} // extern "C"
