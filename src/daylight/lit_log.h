// Which receivers the lights of a run reach, on disk, so that a killed run can go on.
#pragma once

#include "core/file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::daylight {

/// A file of records. Each light has one record at its place: a bit per receiver and a checksum. A record that a kill
/// cut short counts as missing.
class LitLog {
public:
    /// Begins the log at `path` for `receivers` receivers anew. With `isResumed`, opens the log that is there. `key`
    /// tells this run from others. Throws Error if a log that is to be resumed has another key, if another process
    /// holds it, if the file is no log, or if it has other names (hard links).
    LitLog(const std::string& path, const std::string& key, std::size_t receivers, bool isResumed);

    /// Opens the log at `path`, which another process writes, for reading. Returns nothing if a kill cut off its head.
    /// Throws Error if it has another key, or if the file is no log.
    static std::optional<LitLog> ofAnother(const std::string& path, const std::string& key, std::size_t receivers);

    /// Writes the record of a light: not 0 where a receiver is lit. Lights come in any order.
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit);

    /// Reads the record of `light` into `isLit`, 0 and 1. Returns false if there is no whole record.
    bool read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Lets processes that open the log after this call read what was written.
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

/// Which lights a process decides: all whose number is `rank` modulo `ranks`.
struct LightShare {
    std::uint32_t rank = 0;
    std::uint32_t ranks = 1;

    bool owns(std::size_t light) const { return light % ranks == rank; }
};

/// The logs of one run: one of each rank of this job, and those that an earlier job left. Rank 0 writes STEM.steps,
/// rank N writes STEM.N.steps. Each rank writes its own log alone and reads all others, so a job of another number of
/// ranks can resume the run.
class LitLogs {
public:
    /// Opens the log of `share.rank`, and with `isResumed` all others that are there. Without `isResumed`, rank 0
    /// removes the logs of ranks that this job lacks. Throws Error as LitLog does.
    LitLogs(std::string stem, std::string key, std::size_t receivers, const LightShare& share, bool isResumed);

    /// As LitLog::put, in the log of this rank.
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit) { own_.put(light, isLit); }

    /// As LitLog::read, in any log.
    bool read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Lets other ranks read what this one wrote.
    void handOver() const { own_.handOver(); }

    /// Opens all other logs, with what other ranks handed over.
    void openOthers();

    /// Removes the files of all logs. The run is done.
    void remove() const;

private:
    std::string pathOf(std::uint32_t rank) const;

    /// The files beside STEM that are logs of other ranks, from `firstRank` on.
    std::vector<std::string> otherPaths(std::uint32_t firstRank) const;

    std::string stem_;
    std::string key_;
    std::size_t receivers_;
    std::uint32_t rank_;
    LitLog own_;
    std::vector<LitLog> others_;
};

} // namespace gnomon::daylight
