// Whose threads whose tasks share.
#include "preprocess/distributed/lent_threads.h"

#include <gtest/gtest.h>

namespace gnomon::distributed {
namespace {

using Lent = std::vector<std::size_t>;

TEST(LentThreads, GoToTasksOnTheSameHostAndToNobodyElse) {
    EXPECT_EQ(lentThreads({{"a", 1, true}, {"a", 1, false}}), (Lent{1, 0}));
    EXPECT_EQ(lentThreads({{"a", 1, true}, {"a", 1, true}}), (Lent{0, 0}));
    EXPECT_EQ(lentThreads({{"a", 4, false}, {"a", 4, false}}), (Lent{0, 0})) << "nobody to lend them to";
    EXPECT_EQ(lentThreads({{"a", 1, true}, {"b", 8, false}}), (Lent{0, 0})) << "another host's";
    EXPECT_EQ(lentThreads({{"a", 2, false}, {"b", 8, true}, {"a", 2, true}, {"b", 3, false}}), (Lent{0, 3, 2, 0}));
    EXPECT_EQ(lentThreads({{"a", 5, false}, {"a", 2, true}, {"a", 2, true}}), (Lent{0, 3, 2}))
        << "as evenly as it goes";
    EXPECT_EQ(lentThreads({}), Lent());
}

} // namespace
} // namespace gnomon::distributed
