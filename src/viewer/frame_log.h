// The log of a session in the window: one row per frame, with the same columns as the log of `gnomon bench`. The file
// gets its final name after it is complete.
#pragma once

#include "core/file.h"
#include "telemetry/frame_row.h"

namespace gnomon::viewer {

/// A CSV file with one row per drawn frame.
class FrameLog {
public:
    /// Opens the log. Throws Error if `path` cannot be written.
    explicit FrameLog(const std::string& path);

    void add(const telemetry::FrameRow& row);

    /// Renames the file to its final name.
    void finish() { file_.commit(); }

private:
    void write(const std::string& line);

    AtomicFile file_;
    std::uint64_t bytes_ = 0;
};

} // namespace gnomon::viewer
