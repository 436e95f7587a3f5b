// Requests byte ranges from a web server and checks its answers strictly.
#pragma once

#include "hierarchy/source/access.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

/// Identifies the version of the content at a web address. The content is unchanged if its identity is unchanged. A
/// text is empty if the server does not send it.
struct Identity {
    std::uint64_t size = 0;
    std::string tag;      // the header field ETag
    std::string modified; // the header field Last-Modified

    bool operator==(const Identity&) const = default;
};

/// The reason why a request to a web server received fewer bytes than requested.
enum class Refusal : std::uint8_t {
    Passing,  // no answer, a broken answer, or the server asks to retry later
    Lasting,  // a retry would have the same result
    Changed,  // the content at the address has changed
    Vanished, // the content no longer exists
};

struct RangeFailure {
    Refusal refusal = Refusal::Passing;
    std::string what;
    std::string expected{}; // can be empty, like `found`
    std::string found{};
};

struct RangeAnswer {
    std::size_t received = 0; // number of valid bytes from the start of the range, also if an error followed
    Identity identity;        // set if the whole header is valid
    std::optional<RangeFailure> failure;
};

/// The header fields of an HTTP answer that contains a part of the content (status 206). If a field occurs twice, the
/// last one counts.
struct PartHeader {
    std::string range;    // the header field Content-Range
    std::string encoding; // the header field Content-Encoding
    Identity identity;    // its size is the size of the whole content according to Content-Range

    /// Parses one line of an HTTP header. The names of fields can be in upper or lower case. A status line starts a new
    /// header and clears all fields.
    void take(std::string_view line);
};

/// The position of a part in the content, as the Content-Range field gives it: bytes `first` to `last` of `of` bytes.
/// `partPlace` returns nullopt if the field is incomplete.
struct PartPlace {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::uint64_t of = 0;
};

std::optional<PartPlace> partPlace(const std::string& range);

/// A pool of connections to a web server. Many threads can use the pool, and each request has its own connection.
class Connections {
public:
    /// Creates a connection pool for an http:// or https:// address. Throws Error if libcurl does not start.
    Connections(std::string address, const Access& access);
    ~Connections();
    Connections(const Connections&) = delete;
    Connections& operator=(const Connections&) = delete;
    Connections(Connections&&) = delete;
    Connections& operator=(Connections&&) = delete;

    /// Requests the bytes from `offset` into `out`. Checks that the content still has the identity `known`. If `known`
    /// is null, the content may be shorter than `out`. Additional bytes from the server are ignored.
    RangeAnswer get(std::uint64_t offset, std::span<std::byte> out, const Identity* known) const;

    /// Ends all waiting requests to the server. All later requests fail.
    void stop() const { isStopped_ = true; }

    bool isStopped() const { return isStopped_; }

private:
    class Handle;
    struct Request;

    std::unique_ptr<Handle> taken() const;

    std::string address_;
    std::string authorityFile_;
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<Handle>> idle_;
    mutable std::string redirectedTo_; // host that sent the last part, if the address was redirected
    mutable std::atomic<bool> isStopped_{false};
};

} // namespace gnomon::hierarchy
