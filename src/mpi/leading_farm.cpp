#include "mpi/leading_farm.h"

#include "core/check.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "hierarchy/bytes.h"
#include "preprocess/distributed/messages.h"
#include "telemetry/process_clock.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

namespace gnomon::mpi {

using distributed::Letter;
using distributed::Subject;

/// Tasks of one name, until all are done. Its own ones tell it of their progress.
class LeadingFarm::Run final : public Progress {
public:
    Run(LeadingFarm& farm, const FarmTasks& tasks, const FarmWork& work, Progress& progress)
        : farm_(farm), tasks_(tasks), work_(work), progress_(progress) {
        for (Member& member : farm_.members_)
            member.busySeconds = 0;
    }

    void stage(std::string_view name, std::string_view unit, std::uint64_t total) override {
        progress_.stage(name, unit, total);
    }

    void advance(std::uint64_t count) override {
        progress_.advance(count);
        if (isHere()) talk();
    }

    FarmPhase all() {
        distributed::Patience patience;
        while (taken_ < tasks_.count) {
            bool isBusy = talk();
            isBusy = (isHere() ? performHere() : performBeside()) || isBusy;
            if (isBusy)
                patience.restart();
            else
                patience.wait();
            progress_.advance(0);
        }
        return phase();
    }

private:
    bool isHere() const { return work_.thread == FarmWork::Thread::Calling; }

    /// What one process may have at once: beside timed work it asks for the next task when it is done, else the next
    /// one is there already.
    std::size_t atOnce() const { return isHere() ? 1 : 2; }

    /// Hands out and receives what there is; false if there was nothing.
    bool talk() {
        bool isBusy = false;
        for (handOut(); const std::optional<Letter> letter = farm_.mailbox_.receive(); handOut()) {
            isBusy = true;
            try {
                take(*letter);
            } catch (const hierarchy::Damage& damage) {
                throw Error(farm_.nameOf(letter->from), "it sends what nobody understands: " + damage.what);
            }
        }
        return isBusy;
    }

    void handOut() {
        for (std::size_t round = 0; round < atOnce(); ++round)
            for (std::uint32_t rank = 1; rank < farm_.members_.size(); ++rank) {
                Member& member = farm_.members_[rank];
                if (next_ == tasks_.count || member.running > round) continue;
                const std::size_t task = next_++;
                ++member.running;
                farm_.mailbox_.send(rank, Subject::Task, encoded(Assignment{task, tasks_.input(task)}));
            }
    }

    void take(const Letter& letter) {
        Member& member = farm_.members_[letter.from];
        if (letter.subject == Subject::Failed)
            throw Error(farm_.nameOf(letter.from), distributed::decodedText(letter.bytes));
        if (letter.subject == Subject::News) {
            const News news = decodedNews(letter.bytes);
            progress_.advance(news.progress);
            if (news.isTold && tasks_.hear) tasks_.hear(news.told);
        } else if (letter.subject == Subject::Result) {
            const Outcome outcome = decodedOutcome(letter.bytes);
            --member.running;
            member.report.peakResidentBytes = outcome.peakResidentBytes;
            member.report.bytesSent = outcome.bytesSent + letter.bytes.size();
            taken(member, outcome.task, outcome.result, outcome.seconds);
        }
    }

    void taken(Member& member, std::size_t task, std::span<const std::byte> result, double seconds) {
        ++member.report.tasks;
        member.report.busySeconds += seconds;
        member.busySeconds += seconds;
        ++taken_;
        tasks_.take(task, result);
    }

    bool performHere() {
        if (next_ == tasks_.count) return false;
        const std::size_t task = next_++;
        const Stopwatch watch;
        const TaskBytes result = work_.perform(tasks_.input(task), *this, [this](const TaskBytes& told) {
            if (tasks_.hear) tasks_.hear(told);
        });
        taken(farm_.members_.front(), task, result, watch.elapsed().count / 1000);
        return true;
    }

    bool performBeside() {
        if (own_.valid()) {
            if (own_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
            taken(farm_.members_.front(), ownTask_, own_.get(), sinceOwn_.elapsed().count / 1000);
            return true;
        }
        if (next_ == tasks_.count) return false;
        ownTask_ = next_++;
        sinceOwn_ = {};
        own_ = std::async(
            std::launch::async, [this, input = tasks_.input(ownTask_)] { return work_.perform(input, *this, {}); });
        return true;
    }

    FarmPhase phase() const {
        FarmPhase phase{tasks_.name, tasks_.count, 0, 0};
        double busy = 0;
        for (const Member& member : farm_.members_) {
            busy += member.busySeconds;
            if (member.busySeconds > farm_.members_[phase.slowestRank].busySeconds)
                phase.slowestRank = member.report.rank;
        }
        const double available = watch_.elapsed().count / 1000 * static_cast<double>(farm_.members_.size());
        phase.idleShare = available > 0 ? std::clamp(1 - busy / available, 0.0, 1.0) : 0;
        return phase;
    }

    LeadingFarm& farm_;
    const FarmTasks& tasks_;
    const FarmWork& work_;
    Progress& progress_;
    std::size_t next_ = 0;
    std::size_t taken_ = 0;
    Stopwatch watch_;
    std::size_t ownTask_ = 0;
    Stopwatch sinceOwn_;
    std::future<TaskBytes> own_; // last: it waits for the task that runs
};

LeadingFarm::LeadingFarm(distributed::Mailbox& mailbox) : mailbox_(mailbox), members_(mailbox.count()) {
    for (std::uint32_t rank = 0; rank < members_.size(); ++rank)
        members_[rank].report.rank = rank;
}

std::string LeadingFarm::nameOf(std::uint32_t rank) const {
    const std::string& host = members_[rank].report.host;
    return "rank " + std::to_string(rank) + (host.empty() ? "" : " on " + host);
}

void LeadingFarm::greet(const Letter& letter, const std::string& key) {
    if (letter.subject == Subject::Failed) throw Error(nameOf(letter.from), distributed::decodedText(letter.bytes));
    if (letter.subject != Subject::Hello) throw Error(nameOf(letter.from), "it sends what it should not");
    Greeting greeting = decodedGreeting(letter.bytes);
    Member& member = members_[letter.from];
    member.report = std::move(greeting.self);
    member.report.rank = letter.from;
    member.isThere = true;
    if (greeting.key != key)
        throw Error(nameOf(letter.from), "it works on something else than rank 0", key, greeting.key);
}

void LeadingFarm::gather(const std::string& key, const FarmMember& self, Progress& progress) {
    members_.front().report = self;
    members_.front().report.host = mailbox_.host();
    members_.front().isThere = true;
    distributed::Patience patience;
    while (!std::all_of(members_.begin(), members_.end(), [](const Member& member) { return member.isThere; })) {
        if (const std::optional<Letter> letter = mailbox_.receive()) {
            greet(*letter, key);
            patience.restart();
        } else {
            patience.wait();
        }
        progress.advance(0);
    }
}

void LeadingFarm::serve(const FarmWork& /*work*/, Progress& /*progress*/) {
    GNOMON_CHECK(false); // nobody leads it
}

void LeadingFarm::run(const FarmTasks& tasks, const FarmWork& work, Progress& progress) {
    phases_.push_back(Run(*this, tasks, work, progress).all());
}

FarmReport LeadingFarm::report() const {
    FarmReport report{{}, phases_};
    for (const Member& member : members_)
        report.members.push_back(member.report);
    report.members.front().peakResidentBytes = telemetry::peakResident().count;
    report.members.front().bytesSent = mailbox_.bytesSent();
    return report;
}

} // namespace gnomon::mpi
