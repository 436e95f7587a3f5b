// Writes the checkpoint log in a separate thread. A record is written after its data are on the device.
#pragma once

#include "preprocess/scratch/record_log.h"
#include "preprocess/scratch/scratch_file.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon::pipeline {

/// A writer with one thread. The thread writes all records that arrived during the previous write. A slow disk
/// therefore delays records, not the build. A power cut loses only unwritten records, never the data of a written
/// record.
class RecordWriter {
public:
    struct Entry {
        std::vector<std::byte> record;
        std::vector<std::uint32_t> parts; // parts of the scratch file with the data of the record
        scratch::Blocks freed;            // blocks that are unused after the record is on the device
    };

    /// Creates a writer. `scratch` must outlive it.
    RecordWriter(scratch::RecordLog log, scratch::ScratchFile& scratch);

    /// Discards unwritten records.
    ~RecordWriter();
    RecordWriter(const RecordWriter&) = delete;
    RecordWriter& operator=(const RecordWriter&) = delete;
    RecordWriter(RecordWriter&&) = delete;
    RecordWriter& operator=(RecordWriter&&) = delete;

    /// Adds an entry. Throws the error of an earlier entry if there was one.
    void add(Entry entry);

    /// Waits until all entries are written or one has failed.
    void finish();

private:
    void run();
    void write(const std::vector<Entry>& entries);

    scratch::RecordLog log_;
    scratch::ScratchFile& scratch_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Entry> waiting_;
    std::exception_ptr error_;
    bool isWriting_ = false;
    bool isStopped_ = false;
    std::thread thread_; // must be the last member
};

} // namespace gnomon::pipeline
