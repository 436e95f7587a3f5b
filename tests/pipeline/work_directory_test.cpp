#include "preprocess/pipeline/work_directory.h"
#include "tests/pipeline/test_folder.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

// A resumed build that is refused for lack of memory must not cost what was built before it was killed.
TEST(WorkDirectory, ThatIsLeftCanBeResumed) {
    const TestFolder folder;
    NoProgress progress;
    WorkDirectoryOptions options{folder.file("m.gnm"), "", "the key", false, true};
    {
        WorkDirectory place(options, progress);
        place.scratch("bins")->append(std::vector<std::byte>(1000));
        BinnedRecord record;
        record.largestChunk = {5, 7};
        record.scratchEnd = 1000;
        place.finish(record);
        place.leave();
    }
    EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm.building"});
    {
        WorkDirectory place(options, progress);
        ASSERT_TRUE(place.log().binned());
        EXPECT_EQ(place.log().binned()->largestChunk.triangles, 5U);
        EXPECT_EQ(place.log().binned()->largestChunk.vertices, 7U);
        EXPECT_EQ(place.scratch("bins", 1000)->end(), 1000U);
    }
    EXPECT_EQ(folder.names(), std::set<std::string>{});
}

} // namespace
} // namespace gnomon::pipeline
