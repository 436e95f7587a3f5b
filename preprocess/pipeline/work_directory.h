// The work directory of a build: a folder with scratch files and a checkpoint log. It can also exist only in memory.
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

/// The options for creating the work directory of a build.
struct WorkDirectoryOptions {
    std::string output;      // path of the model to build
    std::string folder;      // folder for temporary files; empty: next to the output
    std::string key;         // key of the build ("name value, name value"); a resumed build requires the same key
    bool isInMemory = false; // whether the directory exists only in memory, without files
    bool isResumed = false;  // whether to continue from existing records, if any
    // This function receives the path of the folder and the reason, if the folder cannot be removed.
    std::function<void(const std::string&)> onKept = {};
    // Max rate of reading and writing temporary data, in bytes per second. 0 means no limit.
    std::uint64_t bytesPerSecond = 0;
};

/// The file names of a build's scratch files.
struct ScratchPlace {
    std::string stem;            // common start of all file names
    std::uint32_t firstPart = 0; // number of the first scratch file (part) that this run writes
};

/// The folder for the temporary files of a build. The destructor removes all files that builds wrote, but no other
/// files. A killed process leaves its files in the folder. Only one process at a time can build an output in a folder.
/// If several processes build the same output in different folders, each of them replaces the whole output at its end.
class WorkDirectory {
public:
    /// Opens the directory. Throws Error if another process uses it, or if the folder belongs to another user or is a
    /// link. Throws Error also if a resumed build has another key. The message then names the differing entries, and no
    /// file is changed. Throws DamageError if a resumed build finds damaged records or scratch files.
    WorkDirectory(const WorkDirectoryOptions& options, Progress& progress);
    ~WorkDirectory() = default;
    WorkDirectory(const WorkDirectory&) = delete;
    WorkDirectory& operator=(const WorkDirectory&) = delete;
    WorkDirectory(WorkDirectory&&) = delete;
    WorkDirectory& operator=(WorkDirectory&&) = delete;

    const CheckpointLog& log() const { return log_; }

    void beginRound(std::uint32_t round) { log_.beginRound(round); }

    scratch::TemporarySpace& space() { return space_; }

    /// Returns the scratch file, which contains all temporary data except the checkpoint log.
    scratch::ScratchFile& scratch() { return *scratch_; }

    /// Returns the file names of the scratch file, so that other processes can open it. The names are empty if the
    /// directory exists only in memory.
    const ScratchPlace& scratchPlace() const { return place_; }

    /// Reserves file numbers (parts) for the scratch files of `count` processes. The numbers are consecutive, and the
    /// first is for this process.
    void expectProcesses(std::uint32_t count);

    /// Writes all pending records and preserves all files for another process. The destructor then removes no file.
    void leave();

    /// Adds `record` to the checkpoint log. The record's data must already be in the scratch file. The blocks `freed`
    /// are freed when the record is on the device. Throws the error of an earlier record that could not be written.
    template <class Record>
    void finish(Record record, scratch::Blocks freed = {}) {
        if (writer_)
            writer_->add({encoded(record), partsOf(record), std::move(freed)});
        else
            release(freed);
        log_.add(std::move(record));
    }

    /// Frees the space of `blocks` in the scratch file.
    void release(const scratch::Blocks& blocks);

private:
    /// The folder and the files of builds that the destructor removes unless `leave` was called. It removes the
    /// checkpoint log first. All files that the log names therefore exist as long as the log exists, and a killed build
    /// can be resumed.
    class Names {
    public:
        explicit Names(std::function<void(const std::string&)> onKept) : onKept_(std::move(onKept)) {}

        ~Names();
        Names(const Names&) = delete;
        Names& operator=(const Names&) = delete;
        Names(Names&&) = delete;
        Names& operator=(Names&&) = delete;

        /// Creates the folder at path `folder`, which the destructor will remove. If the folder exists, the caller must
        /// call `takeOver` instead.
        void make(const std::string& folder);

        /// Registers the existing folder and the files of builds in it. The destructor will remove them.
        void takeOver(const std::string& folder);

        /// Registers the file at `path`. The destructor will remove it.
        void take(const std::string& path);

        void leave();

    private:
        std::function<void(const std::string&)> onKept_;
        std::vector<std::unique_ptr<TemporaryName>> held_; // the first entry is the folder
        // The checkpoint log. It is registered after all names in `held_`, so that it is removed first.
        std::unique_ptr<TemporaryName> log_;
    };

    /// Opens the existing checkpoint log and restores its records. Returns nullopt if there is no log. Throws Error if
    /// the key of the log differs from `key`.
    std::optional<scratch::RecordLog> resumed(const std::string& key);

    /// Creates the scratch file of this process, and removes all files that the checkpoint log does not name. The
    /// number of the new file is the next number after those in the log.
    void makeScratch();

    scratch::TemporarySpace space_;
    std::string folder_; // empty if the directory exists only in memory
    ScratchPlace place_;
    std::uint32_t expected_ = 0; // number of processes whose scratch files are reserved
    std::optional<File> lock_;
    CheckpointLog log_;
    std::unique_ptr<scratch::ScratchFile> scratch_;
    // Declared after the lock, so that all files are removed before the lock is released.
    Names names_;
    std::optional<RecordWriter> writer_; // declared last, so that it never writes to a removed file
};

} // namespace gnomon::pipeline
