// The farm of a process alone does all in order, in the calling thread.
#include "core/process/task_farm.h"

#include <gtest/gtest.h>

#include <thread>

namespace gnomon {
namespace {

TaskBytes bytesOf(std::size_t number) {
    return {static_cast<std::byte>(number)};
}

TEST(LoneFarm, DoesAllTasksInOrderInThisThread) {
    std::vector<std::size_t> taken;
    std::vector<std::size_t> heard;
    FarmTasks tasks;
    tasks.name = "tests";
    tasks.count = 5;
    tasks.input = [](std::size_t task) { return bytesOf(task + 10); };
    tasks.take = [&](std::size_t task, std::span<const std::byte> result) {
        EXPECT_EQ(static_cast<std::size_t>(result.front()), 2 * (task + 10));
        taken.push_back(task);
    };
    tasks.hear = [&](std::span<const std::byte> told) { heard.push_back(static_cast<std::size_t>(told.front())); };
    FarmWork work;
    work.perform = [self = std::this_thread::get_id()](auto input, Progress& /*progress*/, const FarmWork::Tell& tell) {
        EXPECT_EQ(std::this_thread::get_id(), self);
        tell({input.front()});
        return bytesOf(2 * static_cast<std::size_t>(input.front()));
    };
    LoneFarm farm;
    NoProgress silent;
    farm.gather("key", {}, silent);
    EXPECT_FALSE(farm.isLed());
    farm.run(tasks, work, silent);
    EXPECT_EQ(taken, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(heard, (std::vector<std::size_t>{10, 11, 12, 13, 14}));
    tasks.hear = nullptr;
    farm.run(tasks, work, silent);
    EXPECT_EQ(heard.size(), 5U) << "nobody listens";
    EXPECT_TRUE(farm.report().members.empty());
}

TEST(LoneFarm, ThrowsWhatATaskThrowsAndDoesNoMore) {
    std::size_t begun = 0;
    FarmTasks tasks;
    tasks.count = 4;
    tasks.input = [](std::size_t task) { return bytesOf(task); };
    tasks.take = [](std::size_t /*task*/, std::span<const std::byte> /*result*/) {};
    FarmWork work;
    work.perform = [&](auto input, Progress& /*progress*/, const FarmWork::Tell& /*tell*/) -> TaskBytes {
        ++begun;
        if (input.front() == std::byte{2}) throw Interrupted{};
        return {};
    };
    LoneFarm farm;
    NoProgress silent;
    EXPECT_THROW(farm.run(tasks, work, silent), Interrupted);
    EXPECT_EQ(begun, 3U);
}

} // namespace
} // namespace gnomon
