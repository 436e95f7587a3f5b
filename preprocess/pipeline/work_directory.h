// The work directory of a build: a folder with scratch files and a checkpoint log, or only memory.
#pragma once

#include "core/temporary_name.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/record_writer.h"
#include "preprocess/scratch/parted_scratch.h"
#include "preprocess/scratch/record_log.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::pipeline {

/// The options of a work directory.
struct WorkDirectoryOptions {
    std::string output;      // path of the model to build
    std::string folder;      // folder for temporary files; empty: next to the output
    std::string key;         // key of the build ("name value, name value"); a resumed build must have the same key
    bool isInMemory = false; // no files at all
    bool isResumed = false;  // continue from existing records, if any
    std::function<void(const std::string&)> onKept = {}; // receives the folder and the reason if it cannot be removed
    std::uint64_t bytesPerSecond = 0;                    // max rate of reading and writing; 0: no limit
};

/// The place of a build's scratch files.
struct ScratchPlace {
    std::string stem;            // start of their names
    std::uint32_t firstPart = 0; // first part of this run
};

/// A work directory. Its destructor removes all files that builds wrote, and no others. A killed process leaves them.
/// Only one process at a time can build an output in one folder. If several processes build the same output in
/// different folders, each of them replaces the whole output.
class WorkDirectory {
public:
    /// Opens the directory. Throws Error if another process uses it, if the folder belongs to another user or is a
    /// link, or if a resumed build has another key. The message names the differing entries, and no file is changed.
    /// Throws DamageError if a resumed build finds damaged records or scratch files.
    WorkDirectory(const WorkDirectoryOptions& options, Progress& progress);
    ~WorkDirectory() = default;
    WorkDirectory(const WorkDirectory&) = delete;
    WorkDirectory& operator=(const WorkDirectory&) = delete;
    WorkDirectory(WorkDirectory&&) = delete;
    WorkDirectory& operator=(WorkDirectory&&) = delete;

    const CheckpointLog& log() const { return log_; }

    void beginRound(std::uint32_t round) { log_.beginRound(round); }

    scratch::TemporarySpace& space() { return space_; }

    /// Returns the scratch file with all temporary bytes except the log.
    scratch::ScratchFile& scratch() { return *scratch_; }

    /// Returns the place of the parts of `scratch` for other processes. There is none in memory.
    const ScratchPlace& scratchPlace() const { return place_; }

    /// Reserves parts for the scratch files of `count` processes. The parts are consecutive, starting with this
    /// process.
    void expectProcesses(std::uint32_t count);

    /// Writes all records and leaves all files for another process. The destructor then removes nothing.
    void leave();

    /// Adds `record` to the checkpoint log. Its data must already be in the scratch file. The blocks `freed` are freed
    /// after the record is written. Throws the error of an earlier record that could not be written.
    template <class Record>
    void finish(Record record, scratch::Blocks freed = {}) {
        if (writer_)
            writer_->add({encoded(record), partsOf(record), std::move(freed)});
        else
            release(freed);
        log_.add(std::move(record));
    }

    /// Frees the space of `blocks`.
    void release(const scratch::Blocks& blocks);

private:
    /// The folder and the files of builds. The destructor removes them unless `leave` was called. It removes the
    /// checkpoint log first. As long as the log exists, all files that it names exist, so that a killed build can be
    /// resumed.
    class Names {
    public:
        explicit Names(std::function<void(const std::string&)> onKept) : onKept_(std::move(onKept)) {}

        ~Names();
        Names(const Names&) = delete;
        Names& operator=(const Names&) = delete;
        Names(Names&&) = delete;
        Names& operator=(Names&&) = delete;

        /// Creates the folder and takes it over. An existing folder requires `takeOver`.
        void make(const std::string& folder);

        /// Takes over the existing files of builds in the folder.
        void takeOver(const std::string& folder);

        /// Takes over the file at `path`.
        void take(const std::string& path);

        void leave();

    private:
        std::function<void(const std::string&)> onKept_;
        std::vector<std::unique_ptr<TemporaryName>> held_; // the folder is first
        std::unique_ptr<TemporaryName> log_;               // newer than all other files
    };

    /// Resumes from the existing checkpoint log. Returns the log, or nothing if there is none. Throws Error if the log
    /// is of another build.
    std::optional<scratch::RecordLog> resumed(const std::string& key);

    /// Creates the scratch file of this process as a new part after the parts in the log, and removes all other files.
    void makeScratch();

    scratch::TemporarySpace space_;
    std::string folder_; // empty: in memory
    ScratchPlace place_;
    std::uint32_t expected_ = 0; // number of processes
    std::optional<File> lock_;
    CheckpointLog log_;
    std::unique_ptr<scratch::ScratchFile> scratch_;
    Names names_;                        // after the lock, so that all files are removed before the lock is released
    std::optional<RecordWriter> writer_; // last, so that it does not write a file whose name is gone
};

} // namespace gnomon::pipeline
