#include "preprocess/distributed/leader.h"

#include "core/error.h"
#include "core/stopwatch.h"
#include "preprocess/pipeline/build_key.h"
#include "telemetry/process_clock.h"

#include <algorithm>

namespace gnomon::distributed {

namespace {

/// Waits at the end of a scope for all tasks of a pool, because the tasks refer to local objects of this scope.
struct DrainAtEnd {
    explicit DrainAtEnd(TaskPool& drained) : pool(drained) {}

    ~DrainAtEnd() { pool.drain(); }

    DrainAtEnd(const DrainAtEnd&) = delete;
    DrainAtEnd& operator=(const DrainAtEnd&) = delete;
    DrainAtEnd(DrainAtEnd&&) = delete;
    DrainAtEnd& operator=(DrainAtEnd&&) = delete;

    TaskPool& pool;
};

} // namespace

Leader::Leader(Mailbox& mailbox) : mailbox_(mailbox), members_(mailbox.count()) {
    for (std::uint32_t rank = 0; rank < members_.size(); ++rank)
        members_[rank].report.rank = rank;
    Member& own = members_.front();
    own.report.host = mailbox.host();
    own.isThere = own.isReady = own.isGone = true;
}

std::string Leader::nameOf(std::uint32_t rank) const {
    const std::string& host = members_[rank].report.host;
    return "rank " + std::to_string(rank) + (host.empty() ? "" : " on " + host);
}

template <class IsDone>
void Leader::waitForAll(const IsDone& isDone, Progress& progress) {
    Backoff backoff;
    while (!std::all_of(members_.begin(), members_.end(), isDone)) {
        if (const std::optional<Letter> letter = mailbox_.receive()) {
            take(*letter);
            backoff.restart();
        } else {
            backoff.wait();
        }
        progress.advance(0);
    }
}

void Leader::take(const Letter& letter) {
    Member& member = members_[letter.from];
    switch (letter.subject) {
    case Subject::Hello: {
        const Hello hello = decodedHello(letter.bytes);
        member.report.host = hello.host;
        member.report.threads = hello.threads;
        member.isThere = true;
        if (hello.key != key_)
            throw Error(
                nameOf(letter.from),
                "it has other inputs, other options or another version than rank 0; start all ranks with the same "
                "command line",
                key_,
                hello.key);
        break;
    }
    case Subject::Ready:
        member.isReady = true;
        break;
    case Subject::Failed:
        throw Error(nameOf(letter.from), decodedText(letter.bytes));
    case Subject::Bye: {
        const Farewell farewell = decodedFarewell(letter.bytes);
        member.report.peakResidentBytes = farewell.peakResidentBytes;
        member.report.tableBytes = farewell.tableBytes;
        member.report.bytesSent = farewell.bytesSent;
        member.isGone = true;
        break;
    }
    default:
        throw Error(nameOf(letter.from), "it sent an unexpected message; use the same version on all hosts");
    }
}

void Leader::gather(const pipeline::BuildOptions& options, std::size_t threads, Progress& progress) {
    members_.front().report.threads = static_cast<std::uint32_t>(threads);
    key_ = pipeline::keyOf(options);
    pool_.emplace(threads);
    waitForAll([](const Member& member) { return member.isThere; }, progress);
}

void Leader::begin(const pipeline::ScratchPlace& place, Progress& progress) {
    progress_ = &progress;
    for (std::uint32_t rank = 1; rank < members_.size(); ++rank)
        mailbox_.send(rank, Subject::Begin, encoded(Beginning{place}));
    waitForAll([](const Member& member) { return member.isReady; }, progress);
}

void Leader::tell(const pipeline::TaskFacts& facts) {
    for (std::uint32_t rank = 1; rank < members_.size(); ++rank)
        mailbox_.send(rank, Subject::Facts, pipeline::encoded(facts));
}

Leader::Member* Leader::freeMember(std::size_t atOnce) {
    Member* best = nullptr;
    for (Member& member : members_) {
        if (member.running >= std::min<std::size_t>(member.report.threads, atOnce)) continue;
        // Among equally loaded processes the last process receives the task. The leader is the first, and it also
        // handles messages.
        if (best == nullptr || member.running <= best->running) best = &member;
    }
    return best;
}

bool Leader::handOut(
    std::deque<std::uint32_t>& queue, const pipeline::TaskPhase& phase, const pipeline::Perform& perform) {
    bool isBusy = false;
    while (!queue.empty()) {
        Member* const member = freeMember(phase.atOnce);
        if (member == nullptr) break;
        const std::uint32_t rank = member->report.rank;
        const std::uint32_t task = queue.front();
        queue.pop_front();
        ++member->running;
        isBusy = true;
        std::vector<std::byte> input = phase.input(task);
        if (rank > 0)
            mailbox_.send(rank, Subject::Task, encoded(Assignment{phase.kind, task, std::move(input)}));
        else
            pool_->start(
                task, [&perform, kind = phase.kind, input = std::move(input)] { return perform(kind, input); });
    }
    return isBusy;
}

void Leader::count(Member& member, double seconds) {
    --member.running;
    ++member.report.tasks;
    member.report.busySeconds += seconds;
    member.busySeconds += seconds;
    ++share_.tasks;
}

std::optional<Outcome> Leader::receiveOutcome() {
    while (const std::optional<Letter> letter = mailbox_.receive()) {
        if (letter->subject != Subject::Result) {
            take(*letter);
            continue;
        }
        Outcome outcome = decodedOutcome(letter->bytes);
        Member& member = members_[letter->from];
        count(member, outcome.seconds);
        member.report.bytesRead += outcome.bytesRead;
        member.report.bytesWritten += outcome.bytesWritten;
        share_.bytesRead += outcome.bytesRead;
        share_.bytesWritten += outcome.bytesWritten;
        progress_->advance(outcome.progress);
        return outcome;
    }
    return {};
}

void Leader::run(const pipeline::TaskPhase& phase, const pipeline::Perform& perform) {
    const Stopwatch watch;
    const DrainAtEnd drain(*pool_);
    std::deque<std::uint32_t> queue(phase.tasks.begin(), phase.tasks.end());
    std::stable_sort(queue.begin(), queue.end(), [&](std::uint32_t a, std::uint32_t b) {
        return phase.weight(a) > phase.weight(b);
    });
    Backoff backoff;
    for (std::size_t taken = 0; taken < phase.tasks.size();) {
        bool isBusy = handOut(queue, phase, perform);
        if (const std::optional<Finished> own = pool_->finished()) {
            if (own->error) std::rethrow_exception(own->error);
            count(members_.front(), own->seconds);
            phase.take(own->task, own->result);
            ++taken;
            isBusy = true;
        }
        if (const std::optional<Outcome> outcome = receiveOutcome()) {
            phase.take(outcome->task, outcome->result);
            ++taken;
            isBusy = true;
        }
        if (isBusy)
            backoff.restart();
        else
            backoff.wait();
        progress_->advance(0);
    }
    phaseSeconds_ += watch.elapsed().count / 1000;
}

pipeline::TeamShare Leader::endPhase() {
    double busy = 0;
    double available = 0;
    for (Member& member : members_) {
        busy += member.busySeconds;
        available += phaseSeconds_ * member.report.threads;
        if (member.busySeconds > members_[share_.slowest].busySeconds) share_.slowest = member.report.rank;
    }
    // Tasks share the threads of their process, so the sum of the task times can exceed the available thread time.
    share_.idle = available > 0 ? std::clamp(1 - busy / available, 0.0, 1.0) : 0;
    for (Member& member : members_)
        member.busySeconds = 0;
    phaseSeconds_ = 0;
    return std::exchange(share_, {});
}

void Leader::dismiss() {
    constexpr double kMaxSeconds = 60;
    for (std::uint32_t rank = 1; rank < members_.size(); ++rank)
        mailbox_.send(rank, Subject::Stop, {});
    const Stopwatch watch;
    Backoff backoff;
    const auto isGone = [](const Member& member) { return member.isGone; };
    while (!std::all_of(members_.begin(), members_.end(), isGone) || !mailbox_.hasSentAll()) {
        if (watch.elapsed().count / 1000 > kMaxSeconds) mailbox_.abort();
        const std::optional<Letter> letter = mailbox_.receive();
        if (letter && letter->subject == Subject::Bye)
            take(*letter);
        else if (!letter) // messages of other subjects have no effect while the job stops
            backoff.wait();
    }
    members_.front().report.peakResidentBytes = telemetry::peakResident().count;
    members_.front().report.bytesSent = mailbox_.bytesSent();
}

std::vector<pipeline::ProcessReport> Leader::reports() const {
    std::vector<pipeline::ProcessReport> reports;
    for (const Member& member : members_)
        reports.push_back(member.report);
    return reports;
}

} // namespace gnomon::distributed
