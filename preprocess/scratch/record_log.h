// A log of checksummed records, appended to by long work: its file may end anywhere when the process is killed.
#pragma once

#include "core/file.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scratch {

/// An append-only file of records, each with its length and checksum. A record counts once it is whole.
class RecordLog {
public:
    /// An empty log at `path`.
    static RecordLog create(const std::string& path);

    /// The log that an earlier process left at `path`, cut after its last whole record; nothing if there is none.
    static std::optional<RecordLog> reopen(const std::string& path);

    /// The records that `reopen` found, in order.
    const std::vector<std::vector<std::byte>>& records() const { return records_; }

    void append(std::span<const std::byte> record);

    /// Flushes the records to the device.
    void sync() { file_.sync(); }

    std::uint64_t bytes() const { return end_; }

private:
    explicit RecordLog(File file) : file_(std::move(file)) {}

    File file_;
    std::uint64_t end_ = 0;
    std::vector<std::vector<std::byte>> records_;
};

} // namespace gnomon::scratch
