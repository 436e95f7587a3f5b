#include "viewer/frame_log.h"

namespace gnomon::viewer {

FrameLog::FrameLog(const std::string& path) : file_(path) {
    write(telemetry::csvHeader() + "\n");
}

void FrameLog::add(const telemetry::FrameRow& row) {
    write(telemetry::csvRow(row) + "\n");
}

void FrameLog::write(const std::string& line) {
    file_.file().writeAt(bytes_, std::as_bytes(std::span(line)));
    bytes_ += line.size();
}

} // namespace gnomon::viewer
