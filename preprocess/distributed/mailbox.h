// Non-blocking messages between the processes of one MPI job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::distributed {

/// The subject of a message between two processes. It is the MPI tag and determines the type of the content.
enum class Subject : std::uint8_t {
    Hello,  // helper to leader; content: Hello
    Begin,  // leader to helper; content: Beginning
    Facts,  // leader to helper; content: TaskFacts
    Ready,  // helper to leader; no content
    Task,   // leader to helper; content: Assignment
    Result, // helper to leader; content: Outcome
    Failed, // helper to leader; content: a text
    Stop,   // leader to helper; no content
    Bye,    // last message of a helper to the leader; content: Farewell
};

/// A received message, with the MPI rank of the sender.
struct Letter {
    std::uint32_t from = 0;
    Subject subject = Subject::Stop;
    std::vector<std::byte> bytes;
};

/// The connection of this process to its MPI job, from MPI_Init to MPI_Finalize. A process has one mailbox, and only
/// one thread uses it.
class Mailbox {
public:
    Mailbox(int* argc, char*** argv);

    /// Calls MPI_Finalize. All processes of the MPI job must destroy their mailboxes.
    ~Mailbox();
    Mailbox(const Mailbox&) = delete;
    Mailbox& operator=(const Mailbox&) = delete;
    Mailbox(Mailbox&&) = delete;
    Mailbox& operator=(Mailbox&&) = delete;

    std::uint32_t rank() const { return rank_; }

    std::uint32_t count() const { return count_; }

    /// Returns the host name of this process.
    const std::string& host() const { return host_; }

    /// Starts to send a message to the process `to` and returns without waiting. Messages to one receiver arrive in
    /// order. Throws Error if `bytes` exceeds 2 GiB.
    void send(std::uint32_t to, Subject subject, std::vector<std::byte> bytes);

    /// Returns the next received message, or nullopt if no message has arrived.
    std::optional<Letter> receive();

    /// Returns true if MPI has finished sending all messages of this process.
    bool hasSentAll();

    /// Returns the total size in bytes of all messages that this process sent.
    std::uint64_t bytesSent() const { return bytesSent_; }

    /// Ends all processes of the MPI job at once.
    [[noreturn]] void abort();

private:
    struct Sending;

    std::uint32_t rank_ = 0;
    std::uint32_t count_ = 1;
    std::string host_;
    std::vector<std::unique_ptr<Sending>> sending_;
    std::uint64_t bytesSent_ = 0;
};

/// Increasing sleep times between two polls for messages. The time doubles from 20 up to 1000 microseconds, so that a
/// waiting process leaves its core to other processes.
class Backoff {
public:
    void wait();

    void restart() { microseconds_ = kMinMicroseconds; }

private:
    static constexpr int kMinMicroseconds = 20;

    int microseconds_ = kMinMicroseconds;
};

} // namespace gnomon::distributed
