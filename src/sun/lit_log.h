// A log on disk of the receivers that each light reaches, so that an interrupted run can continue.
#pragma once

#include "core/file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::sun {

/// A log file with one record per light direction, at a fixed position. A record has one bit per receiver and a
/// checksum. An incomplete record from a killed process counts as missing.
class LitLog {
public:
    /// Creates the log at `path` for `receivers` receivers, or opens the existing log if `isResumed` is true. `key`
    /// identifies the run. Throws Error if a resumed log has another key, if another process has locked the log, if the
    /// file is not a log, or if it has hard links.
    LitLog(const std::string& path, const std::string& key, std::size_t receivers, bool isResumed);

    /// Opens the log at `path`, which another process writes, for reading. Returns nothing if the header is incomplete.
    /// Throws Error if the log has another key or if the file is not a log.
    static std::optional<LitLog> ofAnother(const std::string& path, const std::string& key, std::size_t receivers);

    /// Writes the record of the light with index `light`. A non-zero element means that the receiver is lit. Lights can
    /// come in any order.
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit);

    /// Reads the record of `light` into `isLit` as 0 and 1. Returns false if there is no complete record.
    bool read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Makes the written records visible to processes that open the log after this call.
    void handOver() const { file_.handOver(); }

private:
    LitLog(File file, const std::string& key, std::size_t receivers);

    std::uint64_t offsetOf(std::size_t light) const { return firstRecord_ + light * recordBytes_; }

    bool hasLog() const;
    void requireKey(const std::string& key) const;

    std::size_t receivers_;
    std::uint64_t firstRecord_;
    std::uint64_t recordBytes_;
    File file_;
};

/// The lights that a process computes: all lights whose index modulo `ranks` is `rank`.
struct LightShare {
    std::uint32_t rank = 0;
    std::uint32_t ranks = 1;

    bool owns(std::size_t light) const { return light % ranks == rank; }
};

/// The logs of one run: one per rank of this job, and the logs of an earlier job. Rank 0 writes STEM.steps, and rank N
/// writes STEM.N.steps. Each rank writes only its own log and reads all others. A job with another number of ranks can
/// therefore resume the run.
class LitLogs {
public:
    /// Opens the log of `share.rank`, and all other existing logs if `isResumed` is true. Otherwise, rank 0 removes the
    /// logs of ranks that this job does not have. Throws the same errors as LitLog.
    LitLogs(std::string stem, std::string key, std::size_t receivers, const LightShare& share, bool isResumed);

    /// Writes a record to the log of this rank (see LitLog::put).
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit) { own_.put(light, isLit); }

    /// Reads a record from any log (see LitLog::read).
    bool read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Makes the records of this rank visible to other ranks.
    void handOver() const { own_.handOver(); }

    /// Opens all other logs, with the records that other ranks handed over.
    void openOthers();

    /// Removes all log files after the run is complete.
    void remove() const;

private:
    std::string pathOf(std::uint32_t rank) const;

    /// Returns the log files of other ranks, from `firstRank` on.
    std::vector<std::string> otherPaths(std::uint32_t firstRank) const;

    std::string stem_;
    std::string key_;
    std::size_t receivers_;
    std::uint32_t rank_;
    LitLog own_;
    std::vector<LitLog> others_;
};

} // namespace gnomon::sun
