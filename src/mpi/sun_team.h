// The processes (ranks) of an MPI job that compute hours of sun together. Each rank computes a fixed share of the
// light directions.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "task/sun_hours_team.h"

#include <functional>
#include <vector>

namespace gnomon::mpi {

/// The ranks of an MPI job that compute hours of sun together. They send messages when they are ready or have failed.
/// One MPI reduction adds the results of all ranks.
class SunTeam final : public task::SunHoursTeam {
public:
    /// Joins the team of ranks. In a rank other than 0, the team calls `noteStop` if rank 0 sends Stop.
    explicit SunTeam(distributed::Mailbox& mailbox, std::function<void()> noteStop = {});

    sun::LightShare share() const override { return {mailbox_.rank(), mailbox_.count()}; }

    void begin(const std::string& key, Progress& progress) override;
    void poll() override;
    void combine(sun::LitSteps& lit, Progress& progress) override;

private:
    struct Member {
        std::string host;
        bool hasArrived = false; // true if the rank has reached the next barrier
    };

    std::string nameOf(std::uint32_t rank) const;
    void takeAsLeader(const distributed::Letter& letter);
    void takeFromLeader(const distributed::Letter& letter);

    /// Waits until all ranks call this function. A rank other than 0 first sends a message with `subject` and `bytes`.
    /// Meanwhile the function polls `progress` for interruptions.
    void exchange(distributed::Subject subject, std::vector<std::byte> bytes, Progress& progress);

    distributed::Mailbox& mailbox_;
    std::function<void()> noteStop_;
    std::string key_;
    std::vector<Member> members_; // used in rank 0
    bool haveAllArrived_ = false; // in ranks other than 0: true if rank 0 has reported the arrival of all ranks
};

} // namespace gnomon::mpi
