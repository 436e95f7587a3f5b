// What was decided so far of many lights, on disk: so that a killed run can go on.
#pragma once

#include "core/file.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::daylight {

/// A file of records, one for each light at its place: a bit for each receiver, checked by a sum. A record that a kill
/// cut short, or that was not there yet, is made again.
class LitLog {
public:
    /// Begins the log at `path` for `receivers` receivers and `lights` lights anew; or, with `isResumed`, opens the one
    /// that is there, of which whole records count. `key` tells what is computed from what. Throws Error if a log that
    /// is to be resumed has another key, or another process holds it, or if what is there is no log, or if it has other
    /// names (hard links).
    LitLog(std::string path, const std::string& key, std::size_t receivers, std::size_t lights, bool isResumed);

    /// Lights whose records are there.
    std::size_t size() const { return size_; }

    bool has(std::size_t light) const { return light < isThere_.size() && isThere_[light]; }

    /// Puts a light's record in its place: not 0 where a receiver is lit. Lights come in any order.
    void put(std::size_t light, const std::vector<std::uint8_t>& isLit);

    /// Reads record `light` into `isLit`, 0 and 1.
    void read(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    /// Removes the file: all is done.
    void remove();

private:
    std::uint64_t offsetOf(std::size_t light) const { return firstRecord_ + light * recordBytes_; }

    bool hasLog() const;
    void resume(const std::string& key, std::size_t lights);
    bool isWhole(std::size_t light) const;
    void note(std::size_t light);

    std::string path_;
    std::size_t receivers_;
    std::uint64_t firstRecord_ = 0;
    std::uint64_t recordBytes_ = 0;
    std::size_t size_ = 0;
    std::vector<bool> isThere_; // by light
    File file_;
};

} // namespace gnomon::daylight
