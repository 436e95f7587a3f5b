// A local HTTP server that sends scripted answers, byte by byte.
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

/// A request for the bytes `first` to `last`.
struct RangeQuestion {
    unsigned number = 0; // index among all requests so far
    std::string path;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    bool isOfRange = false; // if false, the request has no range and both are 0
};

/// The raw bytes of an answer.
struct RawAnswer {
    std::string bytes;
    bool hangsUp = false; // closes the connection after the answer
    bool repeats = false; // repeats the last 4 KiB until the client closes the connection
};

/// Returns a complete and correct answer with the requested part of `content`. `changes` replace header lines of the
/// same name, for example "ETag: \"b\"". `body` replaces the part.
RawAnswer partOf(
    const std::string& content,
    const RangeQuestion& question,
    const std::vector<std::string>& changes = {},
    const std::string* body = nullptr);

/// Returns an answer that contains only a status.
RawAnswer statusOnly(int status, const std::string& header = "");

/// A server on 127.0.0.1 during its lifetime, with one thread per connection.
class ScriptedServer {
public:
    explicit ScriptedServer(std::function<RawAnswer(const RangeQuestion&)> answer, std::uint16_t port = 0);
    ~ScriptedServer();
    ScriptedServer(const ScriptedServer&) = delete;
    ScriptedServer& operator=(const ScriptedServer&) = delete;
    ScriptedServer(ScriptedServer&&) = delete;
    ScriptedServer& operator=(ScriptedServer&&) = delete;

    /// Returns the address of "/model.gnm" on this server.
    std::string address() const;

    std::uint16_t port() const { return port_; }

    unsigned questions() const { return questions_; }

    unsigned connections() const { return connections_; }

    /// Returns the max number of bytes sent on one connection.
    std::uint64_t maxSent() const { return maxSent_; }

private:
    void accept();
    void serve(int connection);

    std::function<RawAnswer(const RangeQuestion&)> answer_;
    int listener_ = -1;
    std::uint16_t port_ = 0;
    std::atomic<unsigned> questions_{0};
    std::atomic<unsigned> connections_{0};
    std::atomic<std::uint64_t> maxSent_{0};
    std::mutex mutex_;
    std::vector<int> open_;
    std::vector<std::thread> threads_;
    std::thread acceptor_;
};

} // namespace gnomon::tests
