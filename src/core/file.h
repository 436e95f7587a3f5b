// File I/O with error checks. Each short read, failed write or full disk throws an Error with path and offset.
#pragma once

#include "core/temporary_name.h"
#include "core/units.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// An open file that can be moved but not copied. Many threads can read and write it at the same time with the
/// functions that take an offset.
class File {
public:
    /// The way to open a file.
    /// - Read opens a file for reading and follows links.
    /// - Device opens a device or pipe, or overwrites an existing file. It follows links.
    /// - Create replaces any file of this name by a new one.
    /// - Update opens an existing file for reading and writing.
    /// - Lock opens a file for reading and writing, and creates a missing file.
    /// Create, Update and Lock never write to the target of a link.
    enum class Mode { Read, Create, Update, Lock, Device };

    /// Opens `path`. Throws Error with the reason that the operating system reports.
    File(const std::string& path, Mode mode);

    /// Opens `path`. Error messages and `path()` use the name `displayPath` instead.
    File(const std::string& path, Mode mode, std::string displayPath);

    /// Creates a new file for reading and writing. Returns nullopt if a file or link with this name exists. The
    /// permissions are `permissions` without the bits of the user's umask.
    static std::optional<File> createdNew(const std::string& path, unsigned permissions, std::string displayPath);

    ~File();
    File(File&& other) noexcept;
    File& operator=(File&& other) noexcept;
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    const std::string& path() const { return path_; }

    std::uint64_t size() const;

    /// Returns the time at which the content of the file last changed, in nanoseconds since 1970.
    std::int64_t changeTime() const;

    /// Fills `out` with the bytes of the file from `offset`. Throws Error if the file ends earlier.
    void readAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Reads up to `out.size()` bytes from `offset` and returns how many it read. The result is smaller than
    /// `out.size()` only at the end of the file.
    std::size_t readSomeAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Reads the next bytes in sequence and returns how many it read. The result is 0 at the end of the file. The
    /// function also works for pipes and devices, which cannot read at an offset.
    std::size_t readSome(std::span<std::byte> out);

    /// Writes all of `bytes` at `offset`.
    void writeAt(std::uint64_t offset, std::span<const std::byte> bytes);

    /// Sets the size of the file to `bytes`: truncates the file, or extends it with zeros.
    void resize(std::uint64_t bytes);

    /// Frees the disk space of a byte range (punches a hole) if the file system supports this. The range then reads as
    /// zeros. Without this support, the range does not change.
    void release(std::uint64_t offset, std::uint64_t bytes);

    /// Tries to lock the file exclusively, and returns true on success. The lock ends when the file is closed or the
    /// process ends.
    bool tryLock();

    /// Gives this file the permissions of the file at `path`, and its owner if the system allows this. Does nothing if
    /// there is no file at `path`.
    void resemble(const std::string& path);

    /// Makes the written bytes visible to processes that open the file later. This is necessary on network file systems
    /// with "close-to-open" consistency. The function does not flush to a local disk.
    void handOver() const;

    /// Flushes the file to the disk, so that a later rename is safe.
    void sync();

private:
    File(int descriptor, std::string displayPath);

    std::string path_;
    int descriptor_ = -1;
};

/// An output file that appears under its final name only when it is complete. The bytes go to a temporary file
/// FINAL.PROCESS.RANDOM.partial in the same folder. `commit` renames this file. If `commit` was not called, the
/// destructor removes it. The class follows links, and never replaces a device or a pipe. A new file copies the
/// permissions of the replaced file and, if allowed, its owner.
class AtomicFile {
public:
    explicit AtomicFile(const std::string& finalPath);

    File& file() { return *file_; }

    /// Returns the path of the temporary file. Returns nullopt for devices and pipes, because their bytes go to the
    /// final name directly.
    std::optional<std::string> temporaryPath() const;

    /// Completes the file: flushes it to the disk and renames it to its final name.
    void commit();

private:
    std::string finalPath_;
    std::optional<TemporaryName> temporary_; // empty if the bytes go to the final name directly
    std::optional<File> file_;
};

/// Reads the whole text of a small file, pipe or device. Throws Error if it has more than `maxBytes` bytes.
std::string readTextFile(const std::string& path, Bytes maxBytes = {std::uint64_t{1} << 30U});

/// Writes `text` to `path`. The file appears there only when it is complete.
void writeTextFile(const std::string& path, const std::string& text);

} // namespace gnomon
