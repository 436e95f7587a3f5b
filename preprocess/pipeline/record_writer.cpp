#include "preprocess/pipeline/record_writer.h"

#include <algorithm>
#include <utility>

namespace gnomon::pipeline {

RecordWriter::RecordWriter(scratch::RecordLog log, scratch::ScratchFile& scratch)
    : log_(std::move(log)), scratch_(scratch), thread_([this] { run(); }) {}

RecordWriter::~RecordWriter() {
    {
        const std::scoped_lock lock(mutex_);
        isStopped_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void RecordWriter::add(Entry entry) {
    {
        const std::scoped_lock lock(mutex_);
        if (error_) std::rethrow_exception(error_);
        waiting_.push_back(std::move(entry));
    }
    changed_.notify_all();
}

void RecordWriter::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || (waiting_.empty() && !isWriting_); });
}

void RecordWriter::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return isStopped_ || !waiting_.empty(); });
        if (isStopped_) return;
        const std::vector<Entry> entries = std::exchange(waiting_, {});
        isWriting_ = true;
        lock.unlock();
        std::exception_ptr error;
        try {
            write(entries);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        isWriting_ = false;
        error_ = error;
        changed_.notify_all();
        if (error) return;
    }
}

void RecordWriter::write(const std::vector<Entry>& entries) {
    std::vector<std::uint32_t> parts;
    for (const Entry& entry : entries)
        parts.insert(parts.end(), entry.parts.begin(), entry.parts.end());
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    scratch_.sync(parts);
    for (const Entry& entry : entries)
        log_.append(entry.record);
    log_.sync(); // a block is freed only after the record that replaces it is on the device
    for (const Entry& entry : entries)
        for (const scratch::Block& block : entry.freed)
            scratch_.release(block);
}

} // namespace gnomon::pipeline
