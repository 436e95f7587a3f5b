#include "core/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace gnomon {
namespace {

TEST(Stopwatch, CountsMillisecondsAndNeverBackwards) {
    const Stopwatch watch;
    const Milliseconds before = watch.elapsed();
    EXPECT_GE(before.count, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_GE(watch.elapsed().count, before.count + 5);
}

TEST(Stopwatch, AddsTheTimeOfSomeWorkToASum) {
    double sum = 100;
    addTime(sum, [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
    EXPECT_GE(sum, 102);
    EXPECT_LT(sum, 100 + 60 * 1000) << "milliseconds";
}

} // namespace
} // namespace gnomon
