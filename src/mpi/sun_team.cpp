#include "mpi/sun_team.h"

#include "core/error.h"
#include "hierarchy/bytes.h"
#include "preprocess/distributed/messages.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <mpi.h>

namespace gnomon::mpi {

using distributed::Letter;
using distributed::Subject;

namespace {

template <class Number>
void reduce(std::vector<Number>& values, MPI_Datatype type, MPI_Op operation, bool isRoot) {
    const void* const sent = isRoot ? MPI_IN_PLACE : values.data();
    MPI_Reduce(sent, values.data(), static_cast<int>(values.size()), type, operation, 0, MPI_COMM_WORLD);
}

} // namespace

SunTeam::SunTeam(distributed::Mailbox& mailbox, std::function<void()> noteStop)
    : mailbox_(mailbox), noteStop_(std::move(noteStop)), members_(mailbox.count()) {}

std::string SunTeam::nameOf(std::uint32_t rank) const {
    const std::string& host = members_[rank].host;
    return "rank " + std::to_string(rank) + (host.empty() ? "" : " on " + host);
}

void SunTeam::begin(const std::string& key, Progress& progress) {
    key_ = key;
    exchange(Subject::Hello, encoded(distributed::Hello{mailbox_.host(), 1, key}), progress);
}

void SunTeam::poll() {
    while (const std::optional<Letter> letter = mailbox_.receive())
        if (leads())
            takeAsLeader(*letter);
        else
            takeFromLeader(*letter);
}

void SunTeam::takeAsLeader(const Letter& letter) {
    Member& member = members_[letter.from];
    try {
        if (letter.subject == Subject::Failed) throw Error(nameOf(letter.from), distributed::decodedText(letter.bytes));
        member.hasArrived = true;
        if (letter.subject != Subject::Hello) return;
        const distributed::Hello hello = distributed::decodedHello(letter.bytes);
        member.host = hello.host;
        if (hello.key != key_)
            throw Error(
                nameOf(letter.from),
                "it has another model, other options or another version than rank 0; start all ranks with the same "
                "command line",
                key_,
                hello.key);
    } catch (const hierarchy::Damage& damage) {
        throw Error(
            nameOf(letter.from), "it sent a damaged message; use the same version on all hosts: " + damage.what);
    }
}

void SunTeam::takeFromLeader(const Letter& letter) {
    if (letter.subject == Subject::Begin) haveAllArrived_ = true;
    if (letter.subject != Subject::Stop) return;
    noteStop_();
    throw Interrupted{};
}

void SunTeam::exchange(Subject subject, std::vector<std::byte> bytes, Progress& progress) {
    if (!leads()) mailbox_.send(0, subject, std::move(bytes));
    members_.front().hasArrived = true;
    const auto isOver = [&] {
        const auto hasArrived = [](const Member& member) { return member.hasArrived; };
        return leads() ? std::all_of(members_.begin(), members_.end(), hasArrived) : haveAllArrived_;
    };
    distributed::Backoff backoff;
    for (poll(); !isOver(); poll()) {
        backoff.wait();
        progress.advance(0);
    }
    haveAllArrived_ = false;
    for (std::uint32_t rank = 1; leads() && rank < members_.size(); ++rank) {
        members_[rank].hasArrived = false;
        mailbox_.send(rank, Subject::Begin, {});
    }
}

void SunTeam::combine(sun::LitSteps& lit, Progress& progress) {
    if (lit.count.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw Error("MPI", "too many points for one job", "at most 2^31 - 1", std::to_string(lit.count.size()));
    exchange(Subject::Ready, {}, progress);
    // The last lit step is increased by one, so that 0 means "never lit" and MPI_MAX returns the last step of all
    // ranks.
    for (std::uint32_t& last : lit.last)
        ++last;
    std::vector<std::uint64_t> sums = {lit.samples, lit.withinTolerance};
    reduce(lit.count, MPI_UINT32_T, MPI_SUM, leads());
    reduce(lit.first, MPI_UINT32_T, MPI_MIN, leads());
    reduce(lit.last, MPI_UINT32_T, MPI_MAX, leads());
    reduce(sums, MPI_UINT64_T, MPI_SUM, leads());
    for (std::uint32_t& last : lit.last)
        --last;
    lit.samples = sums[0];
    lit.withinTolerance = sums[1];
}

} // namespace gnomon::mpi
