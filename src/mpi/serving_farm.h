// A process of another rank than 0 in a task farm: it does what rank 0 sends.
#pragma once

#include "core/stopwatch.h"
#include "mpi/farm_messages.h"
#include "preprocess/distributed/helper.h"
#include "preprocess/distributed/mailbox.h"

#include <deque>

namespace gnomon::mpi {

class ServingFarm final : public TaskFarm {
public:
    /// `helper` is told when rank 0 says Stop, and says farewell.
    ServingFarm(distributed::Mailbox& mailbox, distributed::Helper& helper) : mailbox_(mailbox), helper_(helper) {}

    bool isLed() const override { return true; }

    void gather(const std::string& key, const FarmMember& self, Progress& progress) override;

    /// Throws what a task throws, and Interrupted if rank 0 says Stop within one.
    void serve(const FarmWork& work, Progress& progress) override;

    void run(const FarmTasks& tasks, const FarmWork& work, Progress& progress) override;

    FarmReport report() const override { return {}; }

private:
    class Counting;

    /// Takes a letter, if one is there.
    bool receive();
    void sendNews(const News& news);
    void sendOutcome(std::uint64_t task, TaskBytes result, double seconds);

    /// One task in this thread, which talks while its progress advances.
    void perform(const FarmWork& work, const Assignment& task, Counting& counting);

    /// One task in a thread beside this one, which talks.
    void performBeside(const FarmWork& work, const Assignment& task, Counting& counting);

    distributed::Mailbox& mailbox_;
    distributed::Helper& helper_;
    std::deque<Assignment> waiting_;
    bool isStopped_ = false;
};

} // namespace gnomon::mpi
