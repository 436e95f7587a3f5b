// The process of rank 0, which knows the state of a build and hands its tasks out.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "preprocess/distributed/messages.h"
#include "preprocess/distributed/task_pool.h"

#include <deque>
#include <optional>

namespace gnomon::distributed {

/// Tasks go to whoever has a thread without one, the largest first; the leader does its share.
class Leader final : public pipeline::ProcessTeam {
public:
    explicit Leader(Mailbox& mailbox);

    std::uint32_t processCount() const override { return mailbox_.count(); }

    void gather(const pipeline::BuildOptions& options, std::size_t threads, Progress& progress) override;
    void begin(const pipeline::ScratchPlace& place, Progress& progress) override;
    void tell(const pipeline::TaskFacts& facts) override;
    void run(const pipeline::TaskPhase& phase, const pipeline::Perform& perform) override;
    pipeline::TeamShare endPhase() override;

    /// Ends the work of all others and waits for them, a minute at most: then all processes are ended.
    void dismiss();

    /// What each did; complete after `dismiss`, but for the bytes that the leader itself read and wrote.
    std::vector<pipeline::ProcessReport> reports() const;

private:
    struct Member {
        pipeline::ProcessReport report;
        bool isThere = false; // it has said Hello
        bool isReady = false;
        bool isGone = false;
        std::size_t running = 0;
        double busySeconds = 0; // in this phase
    };

    /// Whether it has handed out any.
    bool handOut(std::deque<std::uint32_t>& queue, const pipeline::TaskPhase& phase, const pipeline::Perform& perform);

    Member* freeMember(std::size_t atOnce);

    void count(Member& member, double seconds);

    /// Receives letters until one is a result or there is none; throws what a helper failed of.
    std::optional<Outcome> receiveOutcome();

    void take(const Letter& letter);

    /// Waits until `isDone` holds of all members.
    template <class IsDone>
    void waitForAll(const IsDone& isDone, Progress& progress);

    std::string nameOf(std::uint32_t rank) const;

    Mailbox& mailbox_;
    std::vector<Member> members_;
    std::optional<TaskPool> pool_;
    Progress* progress_ = nullptr;
    std::string key_;
    double phaseSeconds_ = 0; // of runs since the last endPhase
    pipeline::TeamShare share_;
};

} // namespace gnomon::distributed
