#include "preprocess/scratch/journal.h"

#include "hierarchy/file_layout.h"

#include <array>
#include <cstring>
#include <filesystem>

namespace gnomon::scratch {

namespace {

using Frame = std::array<std::uint64_t, 2>; // length and checksum, before each record

Frame frameOf(std::span<const std::byte> record) {
    return {record.size(), hierarchy::checksum64(record)};
}

} // namespace

Journal Journal::create(const std::string& path) {
    return Journal(File(path, File::Mode::Create));
}

std::optional<Journal> Journal::reopen(const std::string& path) {
    if (!std::filesystem::exists(path)) return {};
    Journal journal(File(path, File::Mode::Update));
    const std::uint64_t size = journal.file_.size();
    while (size - journal.end_ >= sizeof(Frame)) {
        Frame frame{};
        journal.file_.readAt(journal.end_, std::as_writable_bytes(std::span(frame)));
        if (frame[0] > size - journal.end_ - sizeof(Frame)) break;
        std::vector<std::byte> record(frame[0]);
        journal.file_.readAt(journal.end_ + sizeof(Frame), record);
        if (frameOf(record) != frame) break;
        journal.end_ += sizeof(Frame) + record.size();
        journal.records_.push_back(std::move(record));
    }
    journal.file_.resize(journal.end_);
    return journal;
}

void Journal::append(std::span<const std::byte> record) {
    const Frame frame = frameOf(record);
    std::vector<std::byte> framed(sizeof(Frame) + record.size());
    std::memcpy(framed.data(), frame.data(), sizeof(Frame));
    if (!record.empty()) std::memcpy(framed.data() + sizeof(Frame), record.data(), record.size());
    file_.writeAt(end_, framed);
    end_ += framed.size();
}

} // namespace gnomon::scratch
