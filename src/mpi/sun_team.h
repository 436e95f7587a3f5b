// The ranks of an MPI job that count hours of sun: each decides a fixed share of the directions.
#pragma once

#include "measure/sun_hours_team.h"
#include "preprocess/distributed/mailbox.h"

#include <functional>
#include <vector>

namespace gnomon::mpi {

/// Letters tell who fails and who is ready. One reduce adds the results of all ranks.
class SunTeam final : public measure::SunHoursTeam {
public:
    /// `noteStop` is called in a rank other than 0 when rank 0 says Stop.
    explicit SunTeam(distributed::Mailbox& mailbox, std::function<void()> noteStop = {});

    daylight::LightShare share() const override { return {mailbox_.rank(), mailbox_.count()}; }

    void begin(const std::string& key, Progress& progress) override;
    void poll() override;
    void combine(daylight::LitSteps& lit, Progress& progress) override;

private:
    struct Member {
        std::string host;
        bool hasArrived = false; // at the next meeting
    };

    std::string nameOf(std::uint32_t rank) const;
    void takeAsLeader(const distributed::Letter& letter);
    void takeFromLeader(const distributed::Letter& letter);

    /// Waits until all ranks call this. A rank other than 0 sends a letter first. `progress` is polled for
    /// interruptions.
    void meet(distributed::Subject subject, std::vector<std::byte> bytes, Progress& progress);

    distributed::Mailbox& mailbox_;
    std::function<void()> noteStop_;
    std::string key_;
    std::vector<Member> members_; // in rank 0
    bool haveAllArrived_ = false; // in other ranks: rank 0 said so
};

} // namespace gnomon::mpi
