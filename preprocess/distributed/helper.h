// The helper processes of a distributed build, which run tasks of the leading process.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "preprocess/distributed/messages.h"

namespace gnomon::distributed {

/// A helper process of a distributed build (MPI rank above 0). It runs the tasks that the leader assigns.
class Helper {
public:
    explicit Helper(Mailbox& mailbox) : mailbox_(mailbox) {}

    /// Connects to the leader and runs its tasks on `source` until the leader sends the message Stop. The function
    /// polls `progress` for interruptions. It sends errors to the leader, and the leader reports them to the user.
    void serve(read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress);

    /// Sends the leader the reason `why` this process cannot continue. Only the first call has an effect.
    void fail(const std::string& why);

    /// Records that this process has already received the message Stop, so that `leave` does not wait for it.
    void noteStop() { isStopped_ = true; }

    /// Waits for the leader's message Stop if it has not arrived yet. Then sends the message Bye to the leader.
    void leave();

private:
    class Work;

    /// Processes one message of the leader, or the result of one finished task. Returns false if there was neither.
    /// Throws the error of a failed task.
    bool isBusy(Work& work);

    Mailbox& mailbox_;
    std::uint64_t tableBytes_ = 0;
    bool hasFailed_ = false;
    bool isStopped_ = false;
};

} // namespace gnomon::distributed
