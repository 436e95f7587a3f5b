// The log of a session: a row per frame, in the columns of a bench, under its final name once it is complete.
#pragma once

#include "core/file.h"
#include "telemetry/frame_row.h"

namespace gnomon::viewer {

class FrameLog {
public:
    /// Throws Error if `path` cannot be written.
    explicit FrameLog(const std::string& path);

    void add(const telemetry::FrameRow& row);

    /// Gives the file its name.
    void finish() { file_.commit(); }

private:
    void write(const std::string& line);

    AtomicFile file_;
    std::uint64_t bytes_ = 0;
};

} // namespace gnomon::viewer
