// A process of another rank than 0: it does the tasks that the leader sends, and knows nothing else of the build.
#pragma once

#include "preprocess/distributed/mailbox.h"
#include "preprocess/distributed/messages.h"

namespace gnomon::distributed {

class Helper {
public:
    explicit Helper(Mailbox& mailbox) : mailbox_(mailbox) {}

    /// Says that it is there, and does tasks of `source` until the leader says Stop. `progress` is polled for
    /// interruptions. What fails is told to the leader, who tells the user.
    void serve(read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress);

    /// Tells the leader why this process cannot go on, once.
    void fail(const std::string& why);

    /// Somebody else has received Stop.
    void noteStop() { isStopped_ = true; }

    /// Waits for Stop, if it has not come, and says Bye.
    void leave();

private:
    class Work;

    /// Takes a letter or what a task came to; false if there was neither. Throws what failed.
    bool isBusy(Work& work);

    Mailbox& mailbox_;
    std::uint64_t tableBytes_ = 0;
    bool hasFailed_ = false;
    bool isStopped_ = false;
};

} // namespace gnomon::distributed
