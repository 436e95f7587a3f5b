#include "mpi/serving_farm.h"

#include "core/check.h"
#include "telemetry/process_clock.h"

#include <atomic>
#include <chrono>
#include <future>
#include <utility>

namespace gnomon::mpi {

/// Counts what a task does, tells it now and then, and ends the task once there is a reason to.
class ServingFarm::Counting final : public Progress {
public:
    Counting(ServingFarm& farm, Progress& polled, bool isTalking)
        : farm_(farm), polled_(polled), isTalking_(isTalking) {}

    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t count) override {
        done_ += count;
        if (isEnded_) throw Interrupted{};
        if (isTalking_) talk();
    }

    /// Receives, and tells what was done if it is time to.
    void talk() {
        polled_.advance(0);
        while (farm_.receive()) {
        }
        if (farm_.isStopped_) throw Interrupted{};
        constexpr Milliseconds kBetween{200};
        if (sinceTold_.elapsed() < kBetween) return;
        sinceTold_ = {};
        tellProgress();
    }

    void tellProgress() {
        if (const std::uint64_t done = done_.exchange(0); done > 0) farm_.sendNews({done, false, {}});
    }

    /// Ends a task in another thread.
    void end() { isEnded_ = true; }

private:
    ServingFarm& farm_;
    Progress& polled_;
    bool isTalking_;
    std::atomic<bool> isEnded_{false};
    std::atomic<std::uint64_t> done_{0};
    Stopwatch sinceTold_;
};

void ServingFarm::gather(const std::string& key, const FarmMember& self, Progress& /*progress*/) {
    Greeting greeting{self, key};
    greeting.self.host = mailbox_.host();
    mailbox_.send(0, distributed::Subject::Hello, encoded(greeting));
}

void ServingFarm::run(const FarmTasks& /*tasks*/, const FarmWork& /*work*/, Progress& /*progress*/) {
    GNOMON_CHECK(false); // rank 0 hands out
}

bool ServingFarm::receive() {
    std::optional<distributed::Letter> letter = mailbox_.receive();
    if (!letter) return false;
    if (letter->subject == distributed::Subject::Stop) {
        isStopped_ = true;
        helper_.noteStop();
    }
    if (letter->subject == distributed::Subject::Task) waiting_.push_back(decodedAssignment(letter->bytes));
    return true;
}

void ServingFarm::sendNews(const News& news) {
    mailbox_.send(0, distributed::Subject::News, encoded(news));
}

void ServingFarm::sendOutcome(std::uint64_t task, TaskBytes result, double seconds) {
    Outcome outcome{task, seconds, telemetry::peakResident().count, mailbox_.bytesSent(), std::move(result)};
    mailbox_.send(0, distributed::Subject::Result, encoded(outcome));
}

void ServingFarm::perform(const FarmWork& work, const Assignment& task, Counting& counting) {
    const Stopwatch watch;
    TaskBytes result = work.perform(task.input, counting, [this](TaskBytes told) {
        sendNews({0, true, std::move(told)});
    });
    counting.tellProgress();
    sendOutcome(task.task, std::move(result), watch.elapsed().count / 1000);
}

void ServingFarm::performBeside(const FarmWork& work, const Assignment& task, Counting& counting) {
    const Stopwatch watch;
    std::future<TaskBytes> result =
        std::async(std::launch::async, [&] { return work.perform(task.input, counting, {}); });
    try {
        while (result.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready)
            counting.talk();
    } catch (...) {
        counting.end();
        throw; // once the future has waited for the task
    }
    TaskBytes bytes = result.get();
    counting.tellProgress();
    sendOutcome(task.task, std::move(bytes), watch.elapsed().count / 1000);
}

void ServingFarm::serve(const FarmWork& work, Progress& progress) {
    const bool isTalking = work.thread == FarmWork::Thread::Calling;
    Counting counting(*this, progress, isTalking);
    distributed::Patience patience;
    while (!isStopped_) {
        progress.advance(0);
        if (receive()) {
            patience.restart();
        } else if (!waiting_.empty()) {
            const Assignment task = std::move(waiting_.front());
            waiting_.pop_front();
            if (isTalking)
                perform(work, task, counting);
            else
                performBeside(work, task, counting);
            patience.restart();
        } else {
            patience.wait();
        }
    }
}

} // namespace gnomon::mpi
