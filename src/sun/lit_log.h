// A log on disk that stores, for each light direction, which receivers (points of a model) are lit. With it, an
// interrupted run can continue.
#pragma once

#include "core/file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::sun {

/// A log file with one record per light direction, at a fixed position in the file. A record has one bit per receiver
/// (a tested point), which tells whether it is lit, and a checksum. An incomplete record from a killed process counts
/// as missing.
class LitLog {
public:
    /// Creates a log at `path` for `receivers` tested points. If `isResumed` is true, opens the existing log instead.
    /// `key` identifies the run. Throws Error if a resumed log has another key, if another process has locked the log,
    /// if the file is not a log, or if it has hard links.
    LitLog(const std::string& path, const std::string& key, std::size_t receivers, bool isResumed);

    /// Opens, for reading, the log at `path` that another process writes. Returns nullopt if its header is incomplete.
    /// Throws Error if the log has another key or if the file is not a log.
    static std::optional<LitLog> ofAnother(const std::string& path, const std::string& key, std::size_t receivers);

    /// Writes which receivers (tested points) are lit from the light direction with index `light`. A non-zero element
    /// of `isLit` means that the receiver is lit. The light directions can be written in any order.
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit);

    /// Reads which receivers (tested points) are lit from the light direction with index `light`, and sets `isLit` to 0
    /// or 1 for each. Returns false if the log has no complete record of this light direction.
    bool read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Makes the written records visible to other processes that open the log after this call.
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

/// Selects the light directions that one process computes: all lights whose index modulo `ranks` is `rank`.
struct LightShare {
    std::uint32_t rank = 0;
    std::uint32_t ranks = 1;

    bool owns(std::size_t light) const { return light % ranks == rank; }
};

/// The log files of a run with several processes: one per rank of this job, and those of an earlier job. Rank 0 writes
/// STEM.steps, and rank N writes STEM.N.steps. Each rank writes only its own log and reads all others. A job with
/// another number of ranks can therefore resume the run.
class LitLogs {
public:
    /// Opens the log file of the process `share.rank`, and all other existing logs if `isResumed` is true. Otherwise,
    /// rank 0 removes the logs of ranks that this job does not have. Throws the same errors as the constructor of
    /// LitLog.
    LitLogs(std::string stem, std::string key, std::size_t receivers, const LightShare& share, bool isResumed);

    /// Writes which receivers (tested points) a light direction reaches to the log of this process (see LitLog::put).
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit) { own_.put(light, isLit); }

    /// Reads which receivers (tested points) a light direction reaches, from the log of any process (see LitLog::read).
    bool read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Makes the written records of this process visible to the other processes of the job.
    void handOver() const { own_.handOver(); }

    /// Opens the logs of all other processes, with the records that they have handed over.
    void openOthers();

    /// Removes the log files of all processes after the run is complete.
    void remove() const;

private:
    std::string pathOf(std::uint32_t rank) const;

    /// Returns the paths of the existing log files of other ranks, from rank `firstRank` on.
    std::vector<std::string> otherPaths(std::uint32_t firstRank) const;

    std::string stem_;
    std::string key_;
    std::size_t receivers_;
    std::uint32_t rank_;
    LitLog own_;
    std::vector<LitLog> others_;
};

} // namespace gnomon::sun
