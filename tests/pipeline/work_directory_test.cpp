#include "core/file.h"
#include "preprocess/pipeline/work_directory.h"
#include "preprocess/scratch/stream_store.h"
#include "tests/pipeline/test_folder.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

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
        scratch::StreamStore bins(place.scratch(), 1, 1);
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
