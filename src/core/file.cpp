#include "core/file.h"

#include "core/error.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gnomon {

namespace {

/// Where writing to `path` must end up: beyond symbolic links, whether or not what they lead to is there yet.
std::string beyondLinks(const std::string& path) {
    constexpr int kMaxLinks = 40; // as the kernel: links that lead in a circle end, too
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

} // namespace

File::File(const std::string& path, Mode mode) : File(path, mode, path) {}

File::File(const std::string& path, Mode mode, std::string toldPath) : path_(std::move(toldPath)) {
    const int flags = mode == Mode::Read ? O_RDONLY : mode == Mode::Update ? O_RDWR : (O_RDWR | O_CREAT | O_TRUNC);
    descriptor_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throwSystemError(path_, mode == Mode::Create ? "cannot create" : "cannot open");

    struct stat info {};

    if (::fstat(descriptor_, &info) == 0 && S_ISDIR(info.st_mode)) {
        ::close(descriptor_);
        throw Error(path_, "cannot open: is a directory");
    }
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
        if (put <= 0) throwSystemError(atByte(path_, offset + done), "cannot write");
        done += static_cast<std::size_t>(put);
    }
}

void File::resize(std::uint64_t bytes) {
    if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) throwSystemError(path_, "cannot resize");
}

void File::release(std::uint64_t offset, std::uint64_t bytes) {
    // A file system without holes keeps the bytes, which costs space and nothing else.
    static_cast<void>(::fallocate(
        descriptor_,
        FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
        static_cast<off_t>(offset),
        static_cast<off_t>(bytes)));
}

bool File::tryLock() {
    return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
}

void File::sync() {
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) throwSystemError(path_, "cannot flush");
}

AtomicFile::AtomicFile(const std::string& finalPath)
    : finalPath_(isOtherThanFile(finalPath) ? finalPath : beyondLinks(finalPath)),
      temporaryPath_(
          isOtherThanFile(finalPath_) ? finalPath_ : finalPath_ + "." + std::to_string(::getpid()) + ".partial"),
      file_(temporaryPath_, File::Mode::Create, finalPath) {}

AtomicFile::~AtomicFile() {
    if (!committed_ && temporaryPath_ != finalPath_) ::unlink(temporaryPath_.c_str());
}

void AtomicFile::commit() {
    file_.sync();
    if (temporaryPath_ != finalPath_ && std::rename(temporaryPath_.c_str(), finalPath_.c_str()) != 0)
        throwSystemError(finalPath_, "cannot rename the finished file");
    committed_ = true;
}

std::string readTextFile(const std::string& path) {
    constexpr std::size_t kMost = std::size_t{1} << 30U;
    File file(path, File::Mode::Read);
    // What a pipe or a device holds is known at its end only.
    std::string text;
    std::size_t length = 0;
    for (;;) {
        if (std::max<std::uint64_t>(length, file.size()) > kMost)
            throw Error(path, "too large for a text", "at most 1 GiB", "more");
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
