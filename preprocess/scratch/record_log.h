// A log of records with checksums for long computations. The log remains readable if the process is killed during a
// write.
#pragma once

#include "core/file.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scratch {

/// An append-only file of records, each with a length and a checksum. A reader ignores an incomplete last record.
class RecordLog {
public:
    /// Creates an empty log file at `path`.
    static RecordLog create(const std::string& path);

    /// Opens the log that an earlier process wrote to `path`. Removes the bytes after its last complete record. Returns
    /// nullopt if the file does not exist.
    static std::optional<RecordLog> reopen(const std::string& path);

    /// Returns the records that `reopen` read from the file, in order.
    const std::vector<std::vector<std::byte>>& records() const { return records_; }

    /// Appends one record at the end of the file.
    void append(std::span<const std::byte> record);

    /// Flushes the log file to the device, so that a power cut does not lose the records.
    void sync() { file_.sync(); }

    /// Returns the size of the log file in bytes.
    std::uint64_t bytes() const { return end_; }

private:
    explicit RecordLog(File file) : file_(std::move(file)) {}

    File file_;
    std::uint64_t end_ = 0;
    std::vector<std::vector<std::byte>> records_;
};

} // namespace gnomon::scratch
