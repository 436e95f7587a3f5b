// Letters between the processes of one MPI job: sent and received without waiting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::distributed {

/// What a letter is about.
enum class Subject : std::uint8_t {
    Hello,  // helper to leader: Hello
    Begin,  // leader to helper: Beginning
    Facts,  // leader to helper: TaskFacts
    Ready,  // helper to leader: nothing
    Task,   // leader to helper: Assignment
    Result, // helper to leader: Outcome
    Failed, // helper to leader: a text
    Stop,   // leader to helper: nothing
    Bye,    // helper to leader, its last: Farewell
};

struct Letter {
    std::uint32_t from = 0;
    Subject subject = Subject::Stop;
    std::vector<std::byte> bytes;
};

/// This process's part in an MPI job, from MPI_Init to MPI_Finalize; one in a process, used by one thread.
class Mailbox {
public:
    Mailbox(int* argc, char*** argv);

    /// Ends MPI's part in this process, in all processes together.
    ~Mailbox();
    Mailbox(const Mailbox&) = delete;
    Mailbox& operator=(const Mailbox&) = delete;
    Mailbox(Mailbox&&) = delete;
    Mailbox& operator=(Mailbox&&) = delete;

    std::uint32_t rank() const { return rank_; }

    std::uint32_t count() const { return count_; }

    /// The host's name.
    const std::string& host() const { return host_; }

    /// Begins to send; letters to one receiver arrive in order. Throws Error for more than 2 GiB.
    void send(std::uint32_t to, Subject subject, std::vector<std::byte> bytes);

    /// A letter, if one is there.
    std::optional<Letter> receive();

    /// Whether all letters are on their way.
    bool hasSentAll();

    /// Bytes of all letters that were sent.
    std::uint64_t bytesSent() const { return bytesSent_; }

    /// Ends all processes at once.
    [[noreturn]] void abort();

private:
    struct Sending;

    std::uint32_t rank_ = 0;
    std::uint32_t count_ = 1;
    std::string host_;
    std::vector<std::unique_ptr<Sending>> sending_;
    std::uint64_t bytesSent_ = 0;
};

/// Sleeps a little longer each time, up to a millisecond, until something has come: a waiting process leaves its
/// processor to others.
class Patience {
public:
    void wait();

    void restart() { microseconds_ = kLeast; }

private:
    static constexpr int kLeast = 20;

    int microseconds_ = kLeast;
};

} // namespace gnomon::distributed
