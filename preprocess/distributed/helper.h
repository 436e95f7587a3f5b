// The helper processes of a distributed build.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "preprocess/distributed/messages.h"

namespace gnomon::distributed {

/// A helper: a process of a rank other than 0 that runs the tasks of the leader.
class Helper {
public:
    explicit Helper(Mailbox& mailbox) : mailbox_(mailbox) {}

    /// Reports this process to the leader and runs tasks of `source` until the leader sends Stop. The function polls
    /// `progress` for interruptions. The helper sends errors to the leader, and the leader reports them to the user.
    void serve(read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress);

    /// Sends the leader the reason why this process cannot continue. Only the first call has an effect.
    void fail(const std::string& why);

    /// Records that another receiver of this process received Stop.
    void noteStop() { isStopped_ = true; }

    /// Waits for Stop if it has not arrived, and sends Bye.
    void leave();

private:
    class Work;

    /// Processes one message or the result of one task. Returns false if there was none. Throws the error of a failed
    /// task.
    bool isBusy(Work& work);

    Mailbox& mailbox_;
    std::uint64_t tableBytes_ = 0;
    bool hasFailed_ = false;
    bool isStopped_ = false;
};

} // namespace gnomon::distributed
