// Writes the checkpoint log of a build in a separate thread. It writes a record only after the record's data are on the
// device.
#pragma once

#include "preprocess/scratch/record_log.h"
#include "preprocess/scratch/scratch_file.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon::pipeline {

/// Writes records of the checkpoint log in its own thread. The thread writes all records that arrived during its
/// previous write. A slow disk therefore delays records, but not the build. A power cut loses only records that are not
/// yet written. The data of a written record are never lost.
class RecordWriter {
public:
    struct Entry {
        std::vector<std::byte> record;
        std::vector<std::uint32_t> parts; // scratch files (part numbers) that contain the data of the record
        scratch::Blocks freed;            // blocks that can be freed when the record is on the device
    };

    /// Creates a writer that appends to `log`. `scratch` must outlive the writer.
    RecordWriter(scratch::RecordLog log, scratch::ScratchFile& scratch);

    /// Stops the thread of the writer. Records that are not written yet are lost.
    ~RecordWriter();
    RecordWriter(const RecordWriter&) = delete;
    RecordWriter& operator=(const RecordWriter&) = delete;
    RecordWriter(RecordWriter&&) = delete;
    RecordWriter& operator=(RecordWriter&&) = delete;

    /// Adds a record to the queue of the thread. Throws the error of an earlier record if its writing failed.
    void add(Entry entry);

    /// Waits until all records in the queue are written, or the writing of a record has failed.
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
    std::thread thread_; // declared last, so that it starts when all other members exist
};

} // namespace gnomon::pipeline
