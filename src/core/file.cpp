#include "core/file.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gnomon {

namespace {

/// Resolves the symbolic links of `path`, even if the final target does not exist.
std::string withoutLinks(const std::string& path) {
    constexpr int kMaxLinks = 40; // limit of the Linux kernel; it also detects cycles of links
    std::filesystem::path end = path;
    std::error_code error;
    for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(end, error); ++i)
        end = end.parent_path() / std::filesystem::read_symlink(end, error);
    return end.string();
}

bool isOtherThanFile(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

[[noreturn]] void throwSystemError(const std::string& where, const std::string& what) {
    throw Error(where, what + ": " + std::strerror(errno));
}

constexpr unsigned kNewPermissions = 0666; // before the user's umask

/// Repeats `call` as long as a signal interrupts it, and returns its result.
template <class Call>
auto uninterrupted(const Call& call) {
    for (;;) {
        const auto result = call();
        if (result != -1 || errno != EINTR) return result;
    }
}

int openedDescriptor(const std::string& path, int flags, unsigned permissions) {
    return uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, permissions); });
}

int flagsOf(File::Mode mode) {
    switch (mode) {
    case File::Mode::Read:
        return O_RDONLY;
    case File::Mode::Device:
        return O_RDWR | O_CREAT | O_TRUNC;
    case File::Mode::Lock:
        return O_RDWR | O_CREAT | O_NOFOLLOW;
    default:
        return O_RDWR | O_NOFOLLOW;
    }
}

/// Returns a random number for temporary file names, which other processes cannot predict.
std::uint64_t randomNumber() {
    std::uint64_t number = 0;
    if (uninterrupted([&] { return ::getrandom(&number, sizeof(number), 0); }) == sizeof(number)) return number;
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
}

std::string temporaryPathFor(const std::string& finalPath) {
    std::array<char, 48> text{};
    std::snprintf(
        text.data(),
        text.size(),
        ".%ld.%016llx.partial",
        static_cast<long>(::getpid()),
        static_cast<unsigned long long>(randomNumber()));
    return finalPath + text.data();
}

} // namespace

File::File(const std::string& path, Mode mode) : File(path, mode, path) {}

File::File(const std::string& path, Mode mode, std::string displayPath) : File(-1, std::move(displayPath)) {
    if (mode == Mode::Create) {
        constexpr int kAttempts = 8; // another process can create the same name in between
        std::optional<File> made;
        for (int i = 0; i < kAttempts && !made; ++i) {
            const bool isGone = ::unlink(path.c_str()) == 0 || errno == ENOENT;
            if (!isGone && i + 1 == kAttempts) throwSystemError(path_, "cannot remove the old file");
            made = createdNew(path, kNewPermissions, path_);
        }
        if (!made) throwSystemError(path_, "cannot create");
        descriptor_ = std::exchange(made->descriptor_, -1);
        return;
    }
    descriptor_ = openedDescriptor(path, flagsOf(mode), kNewPermissions);
    if (descriptor_ < 0) throwSystemError(path_, mode == Mode::Device ? "cannot create" : "cannot open");

    struct stat info {};

    if (::fstat(descriptor_, &info) != 0) throwSystemError(path_, "cannot stat");
    if (S_ISDIR(info.st_mode)) throw Error(path_, "cannot open: this is a folder, not a file");
    if (mode == Mode::Update && info.st_nlink > 1)
        throw Error(
            path_,
            "cannot overwrite a file with several hard links; choose another name",
            "1 link",
            std::to_string(info.st_nlink));
}

File::File(int descriptor, std::string displayPath) : path_(std::move(displayPath)), descriptor_(descriptor) {}

std::optional<File> File::createdNew(const std::string& path, unsigned permissions, std::string displayPath) {
    const int descriptor = openedDescriptor(path, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW, permissions);
    if (descriptor >= 0) return File(descriptor, std::move(displayPath));
    if (errno != EEXIST) throwSystemError(displayPath, "cannot create");
    return {};
}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

File::File(File&& other) noexcept : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

File& File::operator=(File&& other) noexcept {
    if (this != &other) {
        if (descriptor_ >= 0) ::close(descriptor_);
        path_ = std::move(other.path_);
        descriptor_ = std::exchange(other.descriptor_, -1);
    }
    return *this;
}

std::uint64_t File::size() const {
    struct stat info {};

    if (::fstat(descriptor_, &info) != 0) throwSystemError(path_, "cannot stat");
    return static_cast<std::uint64_t>(info.st_size);
}

std::int64_t File::changeTime() const {
    struct stat info {};

    if (::fstat(descriptor_, &info) != 0) throwSystemError(path_, "cannot stat");
    return std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
}

std::size_t File::readSomeAt(std::uint64_t offset, std::span<std::byte> out) const {
    std::size_t done = 0;
    while (done < out.size()) {
        const ssize_t got =
            ::pread(descriptor_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throwSystemError(atByte(path_, offset + done), "cannot read");
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

std::size_t File::readSome(std::span<std::byte> out) {
    for (;;) {
        const ssize_t got = ::read(descriptor_, out.data(), out.size());
        if (got >= 0) return static_cast<std::size_t>(got);
        if (errno != EINTR) throwSystemError(path_, "cannot read");
    }
}

void File::readAt(std::uint64_t offset, std::span<std::byte> out) const {
    const std::size_t got = readSomeAt(offset, out);
    if (got < out.size())
        throw Error(
            atByte(path_, offset + got),
            "the file ends too early",
            std::to_string(out.size() - got) + " more bytes",
            "the end");
}

void File::writeAt(std::uint64_t offset, std::span<const std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put =
            ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (put < 0 && errno == EINTR) continue;
        if (put == 0) errno = ENOSPC; // the system gives no reason for a write of 0 bytes
        if (put <= 0) throwSystemError(atByte(path_, offset + done), "cannot write");
        done += static_cast<std::size_t>(put);
    }
}

void File::resize(std::uint64_t bytes) {
    if (uninterrupted([&] { return ::ftruncate(descriptor_, static_cast<off_t>(bytes)); }) != 0)
        throwSystemError(path_, "cannot resize");
}

void File::release(std::uint64_t offset, std::uint64_t bytes) {
    // The result is ignored. On a file system without support for holes, the file only uses more space.
    static_cast<void>(::fallocate(
        descriptor_,
        FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
        static_cast<off_t>(offset),
        static_cast<off_t>(bytes)));
}

bool File::tryLock() {
    return uninterrupted([&] { return ::flock(descriptor_, LOCK_EX | LOCK_NB); }) == 0;
}

void File::handOver() const {
    // On a network file system, closing any descriptor of the file, also a duplicate, makes the client flush its
    // cache.
    const int copy = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) throwSystemError(path_, "cannot copy its descriptor");
    if (::close(copy) != 0 && errno != EINTR) throwSystemError(path_, "cannot write");
}

void File::sync() {
    if (uninterrupted([&] { return ::fsync(descriptor_); }) != 0 && errno != EINVAL && errno != EROFS)
        throwSystemError(path_, "cannot flush");
}

void File::resemble(const std::string& path) {
    struct stat other {};

    if (::stat(path.c_str(), &other) != 0) return;
    const bool isOwned = ::fchown(descriptor_, other.st_uid, other.st_gid) == 0;
    // The system can forbid a change of the owner of the file, and still allow a change to another group of the user.
    if (!isOwned) static_cast<void>(::fchown(descriptor_, static_cast<uid_t>(-1), other.st_gid));
    static_cast<void>(::fchmod(descriptor_, other.st_mode & (isOwned ? 07777U : 0777U)));
}

AtomicFile::AtomicFile(const std::string& finalPath)
    : finalPath_(isOtherThanFile(finalPath) ? finalPath : withoutLinks(finalPath)) {
    if (isOtherThanFile(finalPath_)) {
        file_.emplace(finalPath_, File::Mode::Device, finalPath);
        return;
    }
    constexpr unsigned kOwnersOnly = 0600; // until the permissions of the replaced file are copied
    constexpr int kAttempts = 100;
    const bool isReplacing = std::filesystem::exists(finalPath_);
    for (int i = 0; i < kAttempts && !file_; ++i) {
        const std::string path = temporaryPathFor(finalPath_);
        temporary_.emplace(path, [&] {
            file_ = File::createdNew(path, isReplacing ? kOwnersOnly : kNewPermissions, finalPath);
            return file_.has_value();
        });
    }
    if (!file_) throwSystemError(finalPath, "cannot create");
    if (isReplacing) file_->resemble(finalPath_);
}

std::optional<std::string> AtomicFile::temporaryPath() const {
    return temporary_ ? std::optional(temporary_->path()) : std::nullopt;
}

void AtomicFile::commit() {
    file_->sync();
    if (!temporary_) return;
    const auto rename = [&] {
        return uninterrupted([&] { return std::rename(temporary_->path().c_str(), finalPath_.c_str()); }) == 0;
    };
    if (!temporary_->keep(rename)) throwSystemError(finalPath_, "cannot rename the finished file");
}

std::string readTextFile(const std::string& path, Bytes maxBytes) {
    File file(path, File::Mode::Read);
    // The text is read in blocks, because the size of a pipe or a device is known only at its end.
    std::string text;
    std::size_t length = 0;
    for (;;) {
        if (std::max<std::uint64_t>(length, file.size()) > maxBytes.count)
            throw Error(path, "too large for a text file", "at most " + readableBytes(maxBytes), "more");
        if (length == text.size()) text.resize(std::max<std::size_t>({file.size() + 1, 2 * length, 4096}));
        const std::size_t got = file.readSome(std::as_writable_bytes(std::span(text)).subspan(length));
        if (got == 0) break;
        length += got;
    }
    text.resize(length);
    return text;
}

void writeTextFile(const std::string& path, const std::string& text) {
    AtomicFile output(path);
    output.file().writeAt(0, std::as_bytes(std::span(text)));
    output.commit();
}

} // namespace gnomon
