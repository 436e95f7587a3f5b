#include "preprocess/distributed/helper.h"

#include "core/error.h"
#include "preprocess/distributed/task_pool.h"
#include "preprocess/pipeline/build_key.h"
#include "preprocess/pipeline/tasks/task_work.h"
#include "telemetry/process_clock.h"

#include <tbb/global_control.h>

#include <atomic>
#include <exception>
#include <new>
#include <optional>
#include <utility>

namespace gnomon::distributed {

namespace {

/// Counts the progress of the tasks of a helper process, and interrupts them after `stop`.
class CountedProgress final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t count) override {
        if (isStopped_) throw Interrupted{};
        done_ += count;
    }

    void stop() { isStopped_ = true; }

    /// Returns the number of work units that were done since the last call.
    std::uint64_t take() { return done_.exchange(0); }

private:
    std::atomic<bool> isStopped_{false};
    std::atomic<std::uint64_t> done_{0};
};

std::string textOf(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        return "out of memory";
    } catch (const std::exception& known) {
        return known.what();
    } catch (const hierarchy::Damage& damage) {
        return damage.what;
    } catch (const Interrupted&) {
        return "interrupted";
    }
}

} // namespace

/// The source, options, scratch files and threads of a helper process while it runs tasks.
class Helper::Work {
public:
    Work(read::MeshSource& source, const pipeline::BuildOptions& options, std::size_t threads)
        : source_(source), options_(options), space_(progress_), pool_(threads) {
        space_.limitRate(options.scratchBytesPerSecond);
        source_.pollWith(progress_);
    }

    void begin(const Beginning& beginning, std::uint32_t rank) {
        const pipeline::ScratchPlace& place = beginning.place;
        scratch_.emplace(place.stem, place.firstPart + rank, space_);
        tasks_.emplace(source_, options_.level, *scratch_, progress_);
    }

    void tell(const pipeline::TaskFacts& facts) {
        if (!tasks_) throw Error("rank 0 sent facts about the build before its start");
        tasks_->tell(facts);
    }

    std::uint64_t maxTableBytes() const { return tasks_ ? tasks_->maxTableBytes() : 0; }

    void start(Assignment assignment) {
        const std::uint32_t task = assignment.task;
        pool_.start(task, [this, kind = assignment.kind, input = std::move(assignment.input)] {
            if (!tasks_) throw Error("rank 0 sent a task before the start of the build");
            return tasks_->perform(kind, input);
        });
    }

    std::optional<Finished> finished() { return pool_.finished(); }

    Outcome outcomeOf(Finished finished) {
        Outcome outcome;
        outcome.task = finished.task;
        outcome.seconds = finished.seconds;
        outcome.progress = progress_.take();
        outcome.bytesRead = space_.bytesRead() - std::exchange(bytesRead_, space_.bytesRead());
        outcome.bytesWritten = space_.bytesWritten() - std::exchange(bytesWritten_, space_.bytesWritten());
        outcome.result = std::move(finished.result);
        return outcome;
    }

    void stop() {
        progress_.stop();
        pool_.drain();
    }

private:
    read::MeshSource& source_;
    const pipeline::BuildOptions& options_;
    CountedProgress progress_;
    scratch::TemporarySpace space_;
    std::optional<scratch::PartedScratch> scratch_;
    std::optional<pipeline::TaskWork> tasks_;
    std::uint64_t bytesRead_ = 0;
    std::uint64_t bytesWritten_ = 0;
    TaskPool pool_; // the last member, so that its threads end first
};

void Helper::fail(const std::string& why) {
    if (!std::exchange(hasFailed_, true)) mailbox_.send(0, Subject::Failed, encoded(why));
}

void Helper::serve(read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress) {
    constexpr auto kLimit = tbb::global_control::max_allowed_parallelism;
    const std::size_t threads =
        options.threads > 0 ? static_cast<std::size_t>(options.threads) : tbb::global_control::active_value(kLimit);
    Work work(source, options, threads);
    mailbox_.send(
        0, Subject::Hello, encoded(Hello{mailbox_.host(), static_cast<std::uint32_t>(threads), keyOf(options)}));
    Backoff backoff;
    while (!isStopped_) {
        try {
            if (isBusy(work))
                backoff.restart();
            else
                backoff.wait();
            if (!hasFailed_) progress.advance(0);
        } catch (...) {
            fail(textOf(std::current_exception()));
        }
    }
    work.stop();
    tableBytes_ = work.maxTableBytes();
}

bool Helper::isBusy(Work& work) {
    if (const std::optional<Letter> letter = mailbox_.receive()) {
        if (letter->subject == Subject::Stop) isStopped_ = true;
        if (letter->subject == Subject::Task) work.start(decodedAssignment(letter->bytes));
        if (letter->subject == Subject::Facts) work.tell(pipeline::decodedFacts(letter->bytes));
        if (letter->subject == Subject::Begin) {
            work.begin(decodedBeginning(letter->bytes), mailbox_.rank());
            mailbox_.send(0, Subject::Ready, {});
        }
        return true;
    }
    std::optional<Finished> finished = work.finished();
    if (!finished) return false;
    if (finished->error) std::rethrow_exception(finished->error);
    mailbox_.send(0, Subject::Result, encoded(work.outcomeOf(std::move(*finished))));
    return true;
}

void Helper::leave() {
    Backoff backoff;
    while (!isStopped_) {
        const std::optional<Letter> letter = mailbox_.receive();
        if (letter && letter->subject == Subject::Stop) isStopped_ = true;
        if (!letter) backoff.wait();
    }
    mailbox_.send(
        0, Subject::Bye, encoded(Farewell{telemetry::peakResident().count, tableBytes_, mailbox_.bytesSent()}));
    while (!mailbox_.hasSentAll())
        backoff.wait();
}

} // namespace gnomon::distributed
