// The work directory of a build: a folder of scratch files and a checkpoint log, or memory alone.
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

struct WorkDirectoryOptions {
    std::string output;      // whose model is built
    std::string folder;      // for temporary files; empty: beside the output
    std::string key;         // what is built from what, as "name value, name value": a resumed build must have the same
    bool isInMemory = false; // no files at all
    bool isResumed = false;  // go on with what is there, if anything
    std::function<void(const std::string&)> onKept = {}; // told which folder stays and why, if it cannot be removed
    std::uint64_t bytesPerSecond = 0;                    // read and written at most; 0: no limit
};

/// Where a build's scratch files are.
struct ScratchPlace {
    std::string stem;            // of their names
    std::uint32_t firstPart = 0; // of this run
};

/// What builds write is removed with the object, unless the process is killed, and nothing else. Only one process at a
/// time can work for one output in one folder; of several with folders of their own, each puts a whole model in the
/// output's place.
class WorkDirectory {
public:
    /// Throws Error where another process is at work, where the folder is another user's or a link, or if a resumed
    /// build has another key, naming the entries that differ; then nothing is touched. Throws DamageError if a resumed
    /// build finds records or scratch files that cannot be right.
    WorkDirectory(const WorkDirectoryOptions& options, Progress& progress);
    ~WorkDirectory() = default;
    WorkDirectory(const WorkDirectory&) = delete;
    WorkDirectory& operator=(const WorkDirectory&) = delete;
    WorkDirectory(WorkDirectory&&) = delete;
    WorkDirectory& operator=(WorkDirectory&&) = delete;

    const CheckpointLog& log() const { return log_; }

    void beginRound(std::uint32_t round) { log_.beginRound(round); }

    scratch::TemporarySpace& space() { return space_; }

    /// All temporary bytes but the log's: those that the log tells of and new ones.
    scratch::ScratchFile& scratch() { return *scratch_; }

    /// Where the parts of `scratch` are, for other processes; only on disk.
    const ScratchPlace& scratchPlace() const { return place_; }

    /// From now on the scratch files of `count` processes go with this; their parts follow each other, this one's
    /// first.
    void expectProcesses(std::uint32_t count);

    /// Writes all records. Lets everything stay where it is when the object goes, for another process to go on with.
    void leave();

    /// Adds `record` to the checkpoint log; the data that it names must have been appended. Gives the space of `freed`
    /// back once the record is written. Throws the error of a record before that could not be written.
    template <class Record>
    void finish(Record record, scratch::Blocks freed = {}) {
        if (writer_)
            writer_->add({encoded(record), partsOf(record), std::move(freed)});
        else
            release(freed);
        log_.add(std::move(record));
    }

    /// Gives the space of `blocks` back.
    void release(const scratch::Blocks& blocks);

private:
    /// The folder and the files that builds write into it; they go with it unless it leaves them. The checkpoint log
    /// goes first: while it is there, so is all that it tells of, and a build that is killed can be resumed.
    class Names {
    public:
        explicit Names(std::function<void(const std::string&)> onKept) : onKept_(std::move(onKept)) {}

        ~Names();
        Names(const Names&) = delete;
        Names& operator=(const Names&) = delete;
        Names(Names&&) = delete;
        Names& operator=(Names&&) = delete;

        /// Makes the folder and takes it over; one that is there already is left to `takeOver`.
        void make(const std::string& folder);

        /// From now on what builds write into the folder goes with this.
        void takeOver(const std::string& folder);

        /// So does the file at `path`.
        void take(const std::string& path);

        void leave();

    private:
        std::function<void(const std::string&)> onKept_;
        std::vector<std::unique_ptr<TemporaryName>> held_; // the folder first
        std::unique_ptr<TemporaryName> log_;               // newer than all others
    };

    /// Resumes from the checkpoint log that is there; returns it, or nothing if there is none. Throws Error if it is of
    /// another build.
    std::optional<scratch::RecordLog> resumed(const std::string& key);

    /// Makes the scratch file of this process after those that the log tells of, and removes all others.
    void makeScratch();

    scratch::TemporarySpace space_;
    std::string folder_; // empty: in memory
    ScratchPlace place_;
    std::uint32_t expected_ = 0; // processes
    std::optional<File> lock_;
    CheckpointLog log_;
    std::unique_ptr<scratch::ScratchFile> scratch_;
    Names names_;                        // after the lock, so that all is removed before the lock is free
    std::optional<RecordWriter> writer_; // last, so that it writes no file whose name is gone
};

} // namespace gnomon::pipeline
