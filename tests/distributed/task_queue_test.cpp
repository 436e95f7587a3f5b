// Tasks go to whoever knows them, and none is left or given twice.
#include "core/random.h"
#include "preprocess/distributed/task_queue.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::distributed {
namespace {

TEST(TaskQueue, WithoutHomesKeepsTheOrder) {
    TaskQueue queue({7, 3, 5}, {});
    EXPECT_EQ(queue.takeFor(1), 7U);
    EXPECT_EQ(queue.takeFor(0), 3U);
    EXPECT_EQ(queue.takeFor(1), 5U);
    EXPECT_TRUE(queue.isEmpty());
    EXPECT_TRUE(TaskQueue({}, {}).isEmpty());
}

TEST(TaskQueue, GivesEachItsOwnAndThenThoseOfOthers) {
    TaskQueue queue({7, 3, 5, 1}, {{3, 1}, {1, 1}, {7, 2}, {99, 1}});
    EXPECT_EQ(queue.takeFor(1), 3U) << "its largest";
    EXPECT_EQ(queue.takeFor(0), 7U) << "it has none: the largest";
    EXPECT_EQ(queue.takeFor(2), 5U) << "its own is taken";
    EXPECT_EQ(queue.takeFor(2), 1U) << "another's";
    EXPECT_TRUE(queue.isEmpty());
}

// The slow twin looks through all that is left each time.
TEST(TaskQueue, IsTheSlowOneForRandomHomes) {
    Random random(1);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint32_t> left;
        Homes homes;
        for (std::uint32_t task = 0; task < random.below(40); ++task) {
            left.push_back(task * 3 % 41);
            if (random.below(3) > 0) homes[left.back()] = static_cast<std::uint32_t>(random.below(4));
        }
        TaskQueue queue(left, homes);
        while (!left.empty()) {
            ASSERT_FALSE(queue.isEmpty());
            const auto rank = static_cast<std::uint32_t>(random.below(4));
            const auto own = std::find_if(left.begin(), left.end(), [&](std::uint32_t task) {
                return homes.contains(task) && homes[task] == rank;
            });
            const auto expected = own != left.end() ? own : left.begin();
            ASSERT_EQ(queue.takeFor(rank), *expected);
            left.erase(expected);
        }
        EXPECT_TRUE(queue.isEmpty());
    }
}

} // namespace
} // namespace gnomon::distributed
