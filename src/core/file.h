// Checked file I/O: every short read, failed write and full disk becomes one Error with path and offset.
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

/// An open file, move-only. Positional calls are safe from many threads at once.
class File {
public:
    /// Read follows links, as does Device, which writes to what is no file or overwrites what is there. The others
    /// write to no file of a link's choice: Create makes a new file in the place of any, Update opens one for both
    /// reading and writing, Lock does so and makes it where it is missing.
    enum class Mode { Read, Create, Update, Lock, Device };

    /// Opens `path`. Throws Error with the system's reason.
    File(const std::string& path, Mode mode);

    /// The same; errors and `path()` name the file as `toldPath`.
    File(const std::string& path, Mode mode, std::string toldPath);

    /// A new file that may be read, too; nothing if there is something of this name, a link included. Its permissions
    /// are those of `permissions` that the user's mask leaves.
    static std::optional<File> createdNew(const std::string& path, unsigned permissions, std::string toldPath);

    ~File();
    File(File&& other) noexcept;
    File& operator=(File&& other) noexcept;
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    const std::string& path() const { return path_; }

    std::uint64_t size() const;

    /// When its content was changed last, in nanoseconds since 1970.
    std::int64_t changeTime() const;

    /// Fills `out` from `offset`; throws Error if the file ends before.
    void readAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Up to `out.size()` bytes from `offset`; fewer only at the end of the file.
    std::size_t readSomeAt(std::uint64_t offset, std::span<std::byte> out) const;

    /// Some of what follows what was read by this before, which needs no file that can be read elsewhere; 0 at its end.
    std::size_t readSome(std::span<std::byte> out);

    /// Writes all of `bytes` at `offset`.
    void writeAt(std::uint64_t offset, std::span<const std::byte> bytes);

    /// Cuts the file off at `bytes`, or lengthens it by zeros.
    void resize(std::uint64_t bytes);

    /// Gives the space of a range back where the file system can; the range then reads as zeros or as it was.
    void release(std::uint64_t offset, std::uint64_t bytes);

    /// Whether this open file now has the file's one lock, which ends with it or with the process.
    bool tryLock();

    /// Takes over the permissions of the file at `path`, and its owner as far as that is allowed; nothing if there is
    /// none.
    void resemble(const std::string& path);

    /// Lets others who open the file after this read what was written, on network file systems that promise no more
    /// than that ("close-to-open"). Nothing is flushed to a device of this machine.
    void handOver() const;

    /// Flushes to the device, so that a rename after it is safe.
    void sync();

private:
    File(int descriptor, std::string toldPath);

    std::string path_;
    int descriptor_ = -1;
};

/// A file that appears under its final name only when it is complete: written beside it under a temporary name,
/// FINAL.PROCESS.RANDOM.partial, renamed by `commit`, removed by the destructor otherwise. Links are followed; a device
/// or a pipe is never replaced. A file that is replaced hands on its permissions and, where allowed, its owner.
class AtomicFile {
public:
    explicit AtomicFile(const std::string& finalPath);

    File& file() { return *file_; }

    /// Where it lies until then; nothing if the final name itself is written to.
    std::optional<std::string> temporaryPath() const;

    /// Flushes and renames onto the final name.
    void commit();

private:
    std::string finalPath_;
    std::optional<TemporaryName> temporary_; // none where the final name is written to
    std::optional<File> file_;
};

/// The whole of a small file, pipe or device as text; throws Error beyond `most` bytes.
std::string readTextFile(const std::string& path, Bytes most = {std::uint64_t{1} << 30U});

/// Writes `text` to `path` through an AtomicFile.
void writeTextFile(const std::string& path, const std::string& text);

} // namespace gnomon
