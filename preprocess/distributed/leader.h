// The leader of a distributed build: the process of rank 0, which stores the state of the build and assigns tasks.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "preprocess/distributed/messages.h"
#include "preprocess/distributed/task_pool.h"

#include <deque>
#include <optional>

namespace gnomon::distributed {

/// A team that assigns each task to a process with a free thread, the largest task first. The leader also runs tasks.
class Leader final : public pipeline::ProcessTeam {
public:
    explicit Leader(Mailbox& mailbox);

    std::uint32_t processCount() const override { return mailbox_.count(); }

    void gather(const pipeline::BuildOptions& options, std::size_t threads, Progress& progress) override;
    void begin(const pipeline::ScratchPlace& place, Progress& progress) override;
    void tell(const pipeline::TaskFacts& facts) override;
    void run(const pipeline::TaskPhase& phase, const pipeline::Perform& perform) override;
    pipeline::TeamShare endPhase() override;

    /// Stops all other processes and waits up to one minute for them. After this minute it ends all processes of the
    /// job.
    void dismiss();

    /// Returns one report per process. The reports are complete after `dismiss`, except for the bytes that the leader
    /// itself read and wrote.
    std::vector<pipeline::ProcessReport> reports() const;

private:
    struct Member {
        pipeline::ProcessReport report;
        bool isThere = false; // whether the process sent Hello
        bool isReady = false;
        bool isGone = false;
        std::size_t running = 0;
        double busySeconds = 0; // in this phase
    };

    /// Assigns tasks of `queue` to free threads. Returns true if it assigned at least one task.
    bool handOut(std::deque<std::uint32_t>& queue, const pipeline::TaskPhase& phase, const pipeline::Perform& perform);

    Member* freeMember(std::size_t atOnce);

    void count(Member& member, double seconds);

    /// Receives messages until one contains a result or no message is left. Throws the error of a failed helper.
    std::optional<Outcome> receiveOutcome();

    void take(const Letter& letter);

    /// Waits until `isDone` is true for all members.
    template <class IsDone>
    void waitForAll(const IsDone& isDone, Progress& progress);

    std::string nameOf(std::uint32_t rank) const;

    Mailbox& mailbox_;
    std::vector<Member> members_;
    std::optional<TaskPool> pool_;
    Progress* progress_ = nullptr;
    std::string key_;
    double phaseSeconds_ = 0; // time of all runs since the last endPhase
    pipeline::TeamShare share_;
};

} // namespace gnomon::distributed
