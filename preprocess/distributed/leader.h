// The leader of a distributed build: the process with MPI rank 0. It stores the state of the build and assigns tasks to
// all processes.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "preprocess/distributed/messages.h"
#include "preprocess/distributed/task_pool.h"

#include <deque>
#include <optional>

namespace gnomon::distributed {

/// Runs the tasks of a build in a team of processes. It assigns each task to a process with a free thread, the largest
/// task first. The leader also runs tasks.
class Leader final : public pipeline::ProcessTeam {
public:
    explicit Leader(Mailbox& mailbox);

    std::uint32_t processCount() const override { return mailbox_.count(); }

    void gather(const pipeline::BuildOptions& options, std::size_t threads, Progress& progress) override;
    void begin(const pipeline::ScratchPlace& place, Progress& progress) override;
    void tell(const pipeline::TaskFacts& facts) override;
    void run(const pipeline::TaskPhase& phase, const pipeline::Perform& perform) override;
    pipeline::TeamShare endPhase() override;

    /// Sends the message Stop to all other processes and waits up to one minute for their last messages. After this
    /// minute it ends all processes of the job.
    void dismiss();

    /// Returns one report per process. The reports are complete only after `dismiss`. They do not contain the bytes
    /// that the leader itself read and wrote.
    std::vector<pipeline::ProcessReport> reports() const;

private:
    struct Member {
        pipeline::ProcessReport report;
        bool isThere = false; // whether the process has sent its message Hello
        bool isReady = false;
        bool isGone = false;
        std::size_t running = 0;
        double busySeconds = 0; // time of its tasks in this phase, in seconds
    };

    /// Assigns tasks from `queue` to free threads of all processes. Returns true if it assigned at least one task.
    bool handOut(std::deque<std::uint32_t>& queue, const pipeline::TaskPhase& phase, const pipeline::Perform& perform);

    Member* freeMember(std::size_t atOnce);

    void count(Member& member, double seconds);

    /// Receives messages until a message contains the result of a task, or no message is left. Throws the error of a
    /// failed helper process.
    std::optional<Outcome> receiveOutcome();

    void take(const Letter& letter);

    /// Waits until `isDone(member)` is true for all processes of the team.
    template <class IsDone>
    void waitForAll(const IsDone& isDone, Progress& progress);

    std::string nameOf(std::uint32_t rank) const;

    Mailbox& mailbox_;
    std::vector<Member> members_;
    std::optional<TaskPool> pool_;
    Progress* progress_ = nullptr;
    std::string key_;
    double phaseSeconds_ = 0; // time of all runs since the last endPhase, in seconds
    pipeline::TeamShare share_;
};

} // namespace gnomon::distributed
