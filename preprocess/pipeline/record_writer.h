// Writes the checkpoint log in a separate thread. It writes a record only after the record's data are on the device.
#pragma once

#include "preprocess/scratch/record_log.h"
#include "preprocess/scratch/scratch_file.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon::pipeline {

/// A writer with one thread. The thread writes all records that arrived during its previous write. A slow disk
/// therefore delays records, but not the build. A power cut loses only records that are not yet written. The data of a
/// written record are never lost.
class RecordWriter {
public:
    struct Entry {
        std::vector<std::byte> record;
        std::vector<std::uint32_t> parts; // parts of the scratch file that contain the data of the record
        scratch::Blocks freed;            // blocks that can be freed when the record is on the device
    };

    /// Creates a writer for `log`. `scratch` must outlive it.
    RecordWriter(scratch::RecordLog log, scratch::ScratchFile& scratch);

    /// Stops the thread. Records that are not written yet are lost.
    ~RecordWriter();
    RecordWriter(const RecordWriter&) = delete;
    RecordWriter& operator=(const RecordWriter&) = delete;
    RecordWriter(RecordWriter&&) = delete;
    RecordWriter& operator=(RecordWriter&&) = delete;

    /// Adds an entry to the queue of the thread. Throws the error of an earlier entry if its writing failed.
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
    std::thread thread_; // the last member, so that it starts when all other members exist
};

} // namespace gnomon::pipeline
