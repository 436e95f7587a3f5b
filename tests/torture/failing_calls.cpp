// Preloaded into the program (LD_PRELOAD): counts its calls on files under a folder and its allocations, and makes the
// Nth of a kind fail. Environment:
//   TORTURE_UNDER   folder (absolute, resolved) whose files count; standard output counts always
//   TORTURE_COUNTS  file of at least 8 KiB that is mapped: one 64-bit counter for each kind, in the order of `Kind`
//   TORTURE_KIND    name of the kind that fails; none: only counted
//   TORTURE_AT      number of the call that fails, from 0
//   TORTURE_HOW     EIO, ENOSPC, ENOMEM, EINTR; short: half of the bytes; kill: SIGKILL before the call; killed: after
//   it TORTURE_FOR     how many calls from there on fail (1)
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

enum class Kind : std::uint8_t {
    Open,
    Read,
    Write,
    Sync,
    Rename,
    Map,
    Unlink,
    Folder,
    Size,
    Status,
    Allocation,
    Count
};
constexpr std::array<std::string_view, static_cast<std::size_t>(Kind::Count)> kKindNames = {
    "open", "read", "write", "sync", "rename", "map", "unlink", "folder", "size", "status", "allocation"};

enum class How : std::uint8_t { Errno, Short, KillBefore, KillAfter };

struct Order {
    std::atomic<std::int64_t>* counts = nullptr;
    std::string_view under;
    Kind kind = Kind::Count;
    std::int64_t at = -1;
    std::int64_t times = 1;
    How how = How::Errno;
    int error = EIO;
};

/// Written once, before main; read by every thread.
Order& order() {
    static Order given;
    return given;
}

std::int64_t numberOf(const char* variable, std::int64_t otherwise) {
    const char* const text = std::getenv(variable);
    return text == nullptr ? otherwise : std::atoll(text);
}

/// Just before main, so that what the loader and static initialisers do is not counted.
void readOrder() {
    const char* const counts = std::getenv("TORTURE_COUNTS");
    const char* const under = std::getenv("TORTURE_UNDER");
    if (counts == nullptr || under == nullptr) return;
    const int file = static_cast<int>(syscall(SYS_openat, AT_FDCWD, counts, O_RDWR | O_CLOEXEC, 0));
    if (file < 0) return;
    void* const memory = mmap(nullptr, 8192, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    syscall(SYS_close, file);
    if (memory == MAP_FAILED) return;
    order().under = under;
    order().at = numberOf("TORTURE_AT", -1);
    order().times = numberOf("TORTURE_FOR", 1);
    if (const char* const kind = std::getenv("TORTURE_KIND"))
        order().kind = static_cast<Kind>(std::find(kKindNames.begin(), kKindNames.end(), kind) - kKindNames.begin());
    const std::string_view how = std::getenv("TORTURE_HOW") == nullptr ? "EIO" : std::getenv("TORTURE_HOW");
    if (how == "ENOSPC")
        order().error = ENOSPC;
    else if (how == "ENOMEM")
        order().error = ENOMEM;
    else if (how == "EINTR")
        order().error = EINTR;
    else if (how == "short")
        order().how = How::Short;
    else if (how == "kill")
        order().how = How::KillBefore;
    else if (how == "killed")
        order().how = How::KillAfter;
    order().counts = static_cast<std::atomic<std::int64_t>*>(memory);
}

/// Whether this call, one more of `kind`, is one of those that fail.
bool isItsTurn(Kind kind) {
    if (order().counts == nullptr) return false;
    const std::int64_t number = order().counts[static_cast<std::size_t>(kind)].fetch_add(1);
    return kind == order().kind && number >= order().at && number < order().at + order().times;
}

bool isUnder(const char* path) {
    if (order().counts == nullptr || path == nullptr) return false;
    if (path[0] != '/') return true; // the runner starts the program in the folder
    return std::string_view(path).substr(0, order().under.size()) == order().under;
}

bool isUnder(int file) {
    if (order().counts == nullptr || file < 0 || file == 2) return false;
    if (file == 1) return true;
    std::array<char, 64> link{};
    std::array<char, 4096> name{};
    std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
    const auto length = syscall(SYS_readlink, link.data(), name.data(), name.size() - 1);
    return length > 0 && isUnder(name.data());
}

template <class Call>
Call* next(const char* name) {
    return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name));
}

void die() {
    syscall(SYS_kill, syscall(SYS_getpid), SIGKILL);
}

/// The outcome of a call of `kind` that returns `failed` where it cannot: `real()` unless it is its turn.
template <class Result, class Real>
Result call(Kind kind, bool counts, Result failed, Real real) {
    if (!counts || !isItsTurn(kind)) return real();
    if (order().how == How::KillBefore) die();
    if (order().how == How::KillAfter) {
        real();
        die();
    }
    errno = order().error;
    return failed;
}

/// The same where bytes are moved, of which half may be.
template <class Real>
ssize_t move(Kind kind, int file, std::size_t count, Real real) {
    if (!isUnder(file) || !isItsTurn(kind)) return real(count);
    if (order().how == How::Short) return real(count > 1 ? count / 2 : count);
    if (order().how == How::KillBefore) die();
    if (order().how == How::KillAfter) {
        real(count);
        die();
    }
    errno = order().error;
    return -1;
}

void* allocate(void* (*real)(std::size_t), std::size_t bytes) {
    return call<void*>(Kind::Allocation, true, nullptr, [&] { return real(bytes); });
}

} // namespace

extern "C" {
// What libc names so is named so here; the C library's own allocator is reached by its second names.
// NOLINTBEGIN(readability-identifier-naming, readability-inconsistent-declaration-parameter-name, cert-dcl37-c,
// bugprone-reserved-identifier)
using Main = int(int, char**, char**);
Main* mainOfTheProgram = nullptr;

int orderedMain(int count, char** words, char** environment) {
    readOrder();
    return mainOfTheProgram(count, words, environment);
}

int __libc_start_main(
    Main* main, int count, char** words, void (*begin)(), void (*end)(), void (*unload)(), void* stack) {
    auto* const real = next<int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*)>("__libc_start_main");
    mainOfTheProgram = main;
    return real(orderedMain, count, words, begin, end, unload, stack);
}

extern void* __libc_malloc(std::size_t);
extern void* __libc_memalign(std::size_t, std::size_t);
extern void* __libc_calloc(std::size_t, std::size_t);
extern void* __libc_realloc(void*, std::size_t);

void* malloc(std::size_t bytes) {
    return allocate(__libc_malloc, bytes);
}

void* calloc(std::size_t number, std::size_t bytes) {
    return call<void*>(Kind::Allocation, true, nullptr, [&] { return __libc_calloc(number, bytes); });
}

void* realloc(void* memory, std::size_t bytes) {
    return call<void*>(Kind::Allocation, true, nullptr, [&] { return __libc_realloc(memory, bytes); });
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
    return call<void*>(Kind::Allocation, true, nullptr, [&] { return __libc_memalign(alignment, bytes); });
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) {
    *memory = aligned_alloc(alignment, bytes);
    return *memory == nullptr ? ENOMEM : 0;
}

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const auto mode = static_cast<mode_t>(va_arg(more, int));
    va_end(more);
    return call(Kind::Open, isUnder(path), -1, [&] {
        return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
    });
}

int open64(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const auto mode = static_cast<mode_t>(va_arg(more, int));
    va_end(more);
    return open(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const auto mode = static_cast<mode_t>(va_arg(more, int));
    va_end(more);
    return call(Kind::Open, isUnder(path), -1, [&] {
        return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
    });
}

FILE* fopen(const char* path, const char* mode) {
    return call<FILE*>(
        Kind::Open, isUnder(path), nullptr, [&] { return next<FILE*(const char*, const char*)>("fopen")(path, mode); });
}

FILE* fopen64(const char* path, const char* mode) {
    return fopen(path, mode);
}

ssize_t read(int file, void* to, std::size_t count) {
    return move(Kind::Read, file, count, [&](std::size_t bytes) { return syscall(SYS_read, file, to, bytes); });
}

ssize_t pread(int file, void* to, std::size_t count, off_t at) {
    return move(Kind::Read, file, count, [&](std::size_t bytes) { return syscall(SYS_pread64, file, to, bytes, at); });
}

ssize_t pread64(int file, void* to, std::size_t count, off_t at) {
    return pread(file, to, count, at);
}

std::size_t fread(void* to, std::size_t size, std::size_t count, FILE* stream) {
    static auto* const real = next<std::size_t(void*, std::size_t, std::size_t, FILE*)>("fread");
    return call<std::size_t>(Kind::Read, isUnder(fileno(stream)) && order().how == How::Errno, 0, [&] {
        return real(to, size, count, stream);
    });
}

ssize_t write(int file, const void* from, std::size_t count) {
    return move(Kind::Write, file, count, [&](std::size_t bytes) { return syscall(SYS_write, file, from, bytes); });
}

ssize_t pwrite(int file, const void* from, std::size_t count, off_t at) {
    return move(
        Kind::Write, file, count, [&](std::size_t bytes) { return syscall(SYS_pwrite64, file, from, bytes, at); });
}

ssize_t pwrite64(int file, const void* from, std::size_t count, off_t at) {
    return pwrite(file, from, count, at);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
    return call<ssize_t>(Kind::Write, isUnder(file) && order().how != How::Short, -1, [&] {
        return syscall(SYS_writev, file, parts, count);
    });
}

std::size_t fwrite(const void* from, std::size_t size, std::size_t count, FILE* stream) {
    static auto* const real = next<std::size_t(const void*, std::size_t, std::size_t, FILE*)>("fwrite");
    return call<std::size_t>(
        Kind::Write, isUnder(fileno(stream)) && order().how == How::Errno && order().error != EINTR, 0, [&] {
            return real(from, size, count, stream);
        });
}

int fsync(int file) {
    return call(Kind::Sync, isUnder(file), -1, [&] { return static_cast<int>(syscall(SYS_fsync, file)); });
}

int fdatasync(int file) {
    return call(Kind::Sync, isUnder(file), -1, [&] { return static_cast<int>(syscall(SYS_fdatasync, file)); });
}

int rename(const char* from, const char* to) {
    return call(Kind::Rename, isUnder(from), -1, [&] { return static_cast<int>(syscall(SYS_rename, from, to)); });
}

void* mmap(void* where, std::size_t bytes, int protection, int flags, int file, off_t at) {
    return call(Kind::Map, order().counts != nullptr && (flags & MAP_ANONYMOUS) == 0 && isUnder(file), MAP_FAILED, [&] {
        return reinterpret_cast<void*>(syscall(SYS_mmap, where, bytes, protection, flags, file, at));
    });
}

void* mmap64(void* where, std::size_t bytes, int protection, int flags, int file, off_t at) {
    return mmap(where, bytes, protection, flags, file, at);
}

int unlink(const char* path) {
    return call(Kind::Unlink, isUnder(path), -1, [&] { return static_cast<int>(syscall(SYS_unlink, path)); });
}

int unlinkat(int folder, const char* path, int flags) {
    return call(
        Kind::Unlink, isUnder(path), -1, [&] { return static_cast<int>(syscall(SYS_unlinkat, folder, path, flags)); });
}

int remove(const char* path) {
    return call(Kind::Unlink, isUnder(path), -1, [&] { return next<int(const char*)>("remove")(path); });
}

int rmdir(const char* path) {
    return call(Kind::Unlink, isUnder(path), -1, [&] { return static_cast<int>(syscall(SYS_rmdir, path)); });
}

int mkdir(const char* path, mode_t mode) {
    return call(Kind::Folder, isUnder(path), -1, [&] { return static_cast<int>(syscall(SYS_mkdir, path, mode)); });
}

int fallocate(int file, int mode, off_t from, off_t bytes) {
    return call(Kind::Size, isUnder(file), -1, [&] {
        return static_cast<int>(syscall(SYS_fallocate, file, mode, from, bytes));
    });
}

int ftruncate(int file, off_t bytes) {
    return call(Kind::Size, isUnder(file), -1, [&] { return static_cast<int>(syscall(SYS_ftruncate, file, bytes)); });
}

int fstat(int file, struct stat* to) {
    return call(Kind::Status, isUnder(file), -1, [&] { return static_cast<int>(syscall(SYS_fstat, file, to)); });
}

int stat(const char* path, struct stat* to) {
    return call(Kind::Status, isUnder(path), -1, [&] { return static_cast<int>(syscall(SYS_stat, path, to)); });
}

int lstat(const char* path, struct stat* to) {
    return call(Kind::Status, isUnder(path), -1, [&] { return static_cast<int>(syscall(SYS_lstat, path, to)); });
}

// NOLINTEND(readability-identifier-naming, readability-inconsistent-declaration-parameter-name, cert-dcl37-c,
// bugprone-reserved-identifier)
}
