// The log of a window session. It has one row per frame and the same columns as the log of `gnomon bench`. The file
// gets its final name after it is complete.
#pragma once

#include "core/file.h"
#include "telemetry/frame_row.h"

namespace gnomon::viewer {

/// A CSV file with one row per drawn frame.
class FrameLog {
public:
    /// Creates the log file. Throws Error if `path` cannot be written.
    explicit FrameLog(const std::string& path);

    void add(const telemetry::FrameRow& row);

    /// Completes the log file and renames it to its final name.
    void finish() { file_.commit(); }

private:
    void write(const std::string& line);

    AtomicFile file_;
    std::uint64_t bytes_ = 0;
};

} // namespace gnomon::viewer
