#include "preprocess/scratch/record_log.h"

#include "hierarchy/file_layout.h"

#include <array>
#include <cstring>
#include <filesystem>

namespace gnomon::scratch {

namespace {

using Frame = std::array<std::uint64_t, 2>; // the bytes before each record: its length and its checksum

Frame frameOf(std::span<const std::byte> record) {
    return {record.size(), hierarchy::checksum64(record)};
}

} // namespace

RecordLog RecordLog::create(const std::string& path) {
    return RecordLog(File(path, File::Mode::Create));
}

std::optional<RecordLog> RecordLog::reopen(const std::string& path) {
    if (!std::filesystem::exists(path)) return {};
    RecordLog log(File(path, File::Mode::Update));
    const std::uint64_t size = log.file_.size();
    while (size - log.end_ >= sizeof(Frame)) {
        Frame frame{};
        log.file_.readAt(log.end_, std::as_writable_bytes(std::span(frame)));
        if (frame[0] > size - log.end_ - sizeof(Frame)) break;
        std::vector<std::byte> record(frame[0]);
        log.file_.readAt(log.end_ + sizeof(Frame), record);
        if (frameOf(record) != frame) break;
        log.end_ += sizeof(Frame) + record.size();
        log.records_.push_back(std::move(record));
    }
    log.file_.resize(log.end_);
    return log;
}

void RecordLog::append(std::span<const std::byte> record) {
    const Frame frame = frameOf(record);
    std::vector<std::byte> framed(sizeof(Frame) + record.size());
    std::memcpy(framed.data(), frame.data(), sizeof(Frame));
    if (!record.empty()) std::memcpy(framed.data() + sizeof(Frame), record.data(), record.size());
    file_.writeAt(end_, framed);
    end_ += framed.size();
}

} // namespace gnomon::scratch
