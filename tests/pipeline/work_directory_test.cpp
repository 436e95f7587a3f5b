#include "core/error.h"
#include "core/file.h"
#include "preprocess/pipeline/work_directory.h"
#include "preprocess/scratch/stream_store.h"
#include "tests/pipeline/test_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>

#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::pipeline {
namespace {

/// Tells which names of a folder are removed, in turn.
class Removals {
public:
    explicit Removals(const std::string& folder) : events_(::inotify_init1(IN_NONBLOCK)) {
        EXPECT_GE(::inotify_add_watch(events_, folder.c_str(), IN_DELETE), 0);
    }

    ~Removals() { ::close(events_); }

    Removals(const Removals&) = delete;
    Removals& operator=(const Removals&) = delete;
    Removals(Removals&&) = delete;
    Removals& operator=(Removals&&) = delete;

    std::vector<std::string> names() const {
        std::vector<std::string> names;
        std::array<char, 4096> bytes{};
        for (ssize_t read = 0; (read = ::read(events_, bytes.data(), bytes.size())) > 0;) {
            for (std::size_t at = 0; at < static_cast<std::size_t>(read);) {
                inotify_event event{};
                std::memcpy(&event, bytes.data() + at, sizeof event);
                if (event.len > 0) names.emplace_back(bytes.data() + at + sizeof event);
                at += sizeof event + event.len;
            }
        }
        return names;
    }

private:
    int events_;
};

TEST(WorkDirectory, WritesNoFileThatHasAnotherName) {
    const TestFolder folder;
    NoProgress progress;
    const std::string theirs = folder.file("theirs.txt");
    const std::string checkpoints = folder.file("m.gnm.building/checkpoints");
    const std::string text = "a text that is somebody's own";
    writeTextFile(theirs, text);
    for (const bool isResumed : {false, true}) {
        std::filesystem::create_directory(folder.file("m.gnm.building"));
        std::filesystem::permissions(folder.file("m.gnm.building"), std::filesystem::perms::owner_all);
        std::filesystem::create_hard_link(theirs, checkpoints);
        const WorkDirectoryOptions options{folder.file("m.gnm"), "", "the key", false, isResumed};
        if (isResumed)
            EXPECT_THROW(WorkDirectory(options, progress), Error);
        else
            EXPECT_NO_THROW(WorkDirectory(options, progress)) << "which puts a new file in its place";
        EXPECT_EQ(readTextFile(theirs), text);
        std::filesystem::remove_all(folder.file("m.gnm.building"));
    }
}

// A build that is killed between two removals finds a log that tells of files that are gone.
TEST(WorkDirectory, RemovesTheLogBeforeWhatItTellsOf) {
    const TestFolder folder;
    NoProgress progress;
    const WorkDirectoryOptions options{folder.file("m.gnm"), "", "the key", false, true};
    const std::vector<std::string> expected{"checkpoints", "scratch.1", "scratch.0", "lock"};
    const auto work = [&] {
        auto place = std::make_unique<WorkDirectory>(options, progress);
        place->expectProcesses(2);
        place->scratch().append(std::vector<std::byte>(7));
        scratch::PartedScratch(place->scratchPlace().stem, 1, place->space()).append(std::vector<std::byte>(7));
        return place;
    };
    {
        auto place = work();
        const Removals removals(folder.file("m.gnm.building"));
        place.reset();
        EXPECT_EQ(removals.names(), expected);
    }
    const auto place = work();
    const Removals removals(folder.file("m.gnm.building"));
    const pid_t child = ::fork();
    if (child == 0) TemporaryName::removeAllAndExit(0); // as a signal does
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(removals.names(), expected);
}

TEST(WorkDirectory, TakesTheFilesOfAllItsProcessesAway) {
    const TestFolder folder;
    NoProgress progress;
    const WorkDirectoryOptions options{folder.file("m.gnm"), "", "the key", false, true};
    {
        WorkDirectory place(options, progress);
        place.expectProcesses(3);
        for (const std::uint32_t part : {1U, 2U})
            scratch::PartedScratch(place.scratchPlace().stem, part, place.space()).append(std::vector<std::byte>(7));
        writeTextFile(scratch::partPath(place.scratchPlace().stem, 17), "of a build that no log tells of");
        place.leave();
    }
    {
        WorkDirectory place(options, progress);
        EXPECT_EQ(place.scratchPlace().firstPart, 0U);
        EXPECT_FALSE(std::filesystem::exists(scratch::partPath(place.scratchPlace().stem, 17)));
    }
    EXPECT_EQ(folder.names(), std::set<std::string>{});
}

// A resumed build that is refused for lack of memory must not cost what was built before it was killed.
TEST(WorkDirectory, ThatIsLeftCanBeResumed) {
    const TestFolder folder;
    NoProgress progress;
    WorkDirectoryOptions options{folder.file("m.gnm"), "", "the key", false, true};
    {
        WorkDirectory place(options, progress);
        scratch::StreamStore bins(place.scratch(), chunk::binStreams(0), 1);
        bins.append(0, std::vector<std::byte>(1000));
        place.scratch().append(std::vector<std::byte>(500)); // of what is not finished
        BinnedRecord record;
        record.largestChunk = {5, 7};
        record.directory = bins.directory();
        place.finish(record);
        place.leave();
    }
    EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm.building"});
    {
        WorkDirectory place(options, progress);
        ASSERT_TRUE(place.log().binned());
        EXPECT_EQ(place.log().binned()->largestChunk.triangles, 5U);
        EXPECT_EQ(place.log().binned()->largestChunk.vertices, 7U);
        EXPECT_EQ(place.space().bytes(), 1000U);
        EXPECT_EQ(place.scratchPlace().firstPart, 1U) << "what another process may still write to is left alone";
        EXPECT_EQ(std::filesystem::file_size(folder.file("m.gnm.building/scratch.0")), 1000U);
        std::vector<std::byte> read(1000, std::byte{1});
        scratch::StreamStore(place.scratch(), place.log().binned()->directory).readBlocks(0, [&](auto bytes) {
            read.assign(bytes.begin(), bytes.end());
        });
        EXPECT_EQ(read, std::vector<std::byte>(1000));
    }
    EXPECT_EQ(folder.names(), std::set<std::string>{});
}

} // namespace
} // namespace gnomon::pipeline
