// Writes the checkpoint log beside the build: a record follows once the data that it names are on the device.
#pragma once

#include "preprocess/scratch/record_log.h"
#include "preprocess/scratch/scratch_file.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon::pipeline {

/// One thread writes all records that came while it wrote the records before, so a slow disk delays records, not the
/// build. A power cut loses the records that are not written, and nothing that a written record names.
class RecordWriter {
public:
    struct Entry {
        std::vector<std::byte> record;
        std::vector<std::uint32_t> parts; // of the scratch file, with the data that the record names
        scratch::Blocks freed;            // that nobody needs once the record is on the device
    };

    /// `scratch` must outlive this.
    RecordWriter(scratch::RecordLog log, scratch::ScratchFile& scratch);

    /// Drops the records that are not written.
    ~RecordWriter();
    RecordWriter(const RecordWriter&) = delete;
    RecordWriter& operator=(const RecordWriter&) = delete;
    RecordWriter(RecordWriter&&) = delete;
    RecordWriter& operator=(RecordWriter&&) = delete;

    /// Throws the error of an entry before, if there was one.
    void add(Entry entry);

    /// Waits until all entries are written, or one has failed.
    void finish();

private:
    void run();
    void write(std::vector<Entry> entries);

    scratch::RecordLog log_;
    scratch::ScratchFile& scratch_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Entry> waiting_;
    std::exception_ptr error_;
    bool isWriting_ = false;
    bool isStopped_ = false;
    std::thread thread_; // last
};

} // namespace gnomon::pipeline
