// The process of rank 0 in a task farm: it hands tasks to whoever is free and does its share.
#pragma once

#include "mpi/farm_messages.h"
#include "preprocess/distributed/mailbox.h"

namespace gnomon::mpi {

class LeadingFarm final : public TaskFarm {
public:
    explicit LeadingFarm(distributed::Mailbox& mailbox);

    bool isLed() const override { return false; }

    void gather(const std::string& key, const FarmMember& self, Progress& progress) override;
    void serve(const FarmWork& work, Progress& progress) override;
    void run(const FarmTasks& tasks, const FarmWork& work, Progress& progress) override;
    FarmReport report() const override;

private:
    class Run;

    struct Member {
        FarmMember report;
        bool isThere = false;    // it has said Hello
        std::size_t running = 0; // tasks that it has
        double busySeconds = 0;  // in this run
    };

    std::string nameOf(std::uint32_t rank) const;

    /// Takes a greeting. Throws Error for one of something else, and what a process says that fails.
    void greet(const distributed::Letter& letter, const std::string& key);

    distributed::Mailbox& mailbox_;
    std::vector<Member> members_;
    std::vector<FarmPhase> phases_;
};

} // namespace gnomon::mpi
