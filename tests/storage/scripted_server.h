// A server on this machine that answers as a test says, byte by byte.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::tests {

/// One question for the bytes `first` to `last`.
struct RangeQuestion {
    unsigned number = 0; // of all questions so far, from 0
    std::string path;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    bool isOfRange = false; // else both are 0
};

/// What is sent, as it is.
struct RawAnswer {
    std::string bytes;
    bool hangsUp = false; // behind it
    bool repeats = false; // its last 4 KiB, until the other side hangs up
};

/// The part of `content` that is asked for, in a whole answer that is true but for `changes`, which are put in the
/// place of header lines of the same name: "ETag: \"b\"". `body` takes the place of the part.
RawAnswer partOf(
    const std::string& content,
    const RangeQuestion& question,
    const std::vector<std::string>& changes = {},
    const std::string* body = nullptr);

/// An answer that is a status and nothing else.
RawAnswer statusOnly(int status, const std::string& header = "");

/// Answers on 127.0.0.1 while it lives, each connection in a thread of its own.
class ScriptedServer {
public:
    explicit ScriptedServer(std::function<RawAnswer(const RangeQuestion&)> answer, std::uint16_t port = 0);
    ~ScriptedServer();
    ScriptedServer(const ScriptedServer&) = delete;
    ScriptedServer& operator=(const ScriptedServer&) = delete;
    ScriptedServer(ScriptedServer&&) = delete;
    ScriptedServer& operator=(ScriptedServer&&) = delete;

    /// Of "/model.gnm" there.
    std::string address() const;

    std::uint16_t port() const { return port_; }

    unsigned questions() const { return questions_; }

    unsigned connections() const { return connections_; }

    /// The greatest number of bytes that one connection was sent.
    std::uint64_t mostSent() const { return mostSent_; }

private:
    void accept();
    void serve(int connection);

    std::function<RawAnswer(const RangeQuestion&)> answer_;
    int listener_ = -1;
    std::uint16_t port_ = 0;
    std::atomic<unsigned> questions_{0};
    std::atomic<unsigned> connections_{0};
    std::atomic<std::uint64_t> mostSent_{0};
    std::mutex mutex_;
    std::vector<int> open_;
    std::vector<std::thread> threads_;
    std::thread acceptor_;
};

} // namespace gnomon::tests
