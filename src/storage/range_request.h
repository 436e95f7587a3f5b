// One question to a server, for a range of what lies at an address, and its answer, taken with distrust.
#pragma once

#include "storage/access.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::storage {

/// What tells whether the content at an address is what it was; empty texts are what the server does not say.
struct Identity {
    std::uint64_t size = 0;
    std::string tag;      // ETag
    std::string modified; // Last-Modified

    bool operator==(const Identity&) const = default;
};

/// Why a request got less than it asked for.
enum class Refusal : std::uint8_t {
    Passing,  // no answer, a broken one, or one that says later
    Lasting,  // whoever asks again is told the same
    Changed,  // what lies there is no longer what it was
    Vanished, // there is nothing any more
};

struct RangeFailure {
    Refusal refusal = Refusal::Passing;
    std::string what;
    std::string expected{}; // or empty, as the next
    std::string found{};
};

struct RangeAnswer {
    std::size_t received = 0; // bytes at the range's start that are there and right, whatever came after
    Identity identity;        // once the whole of the header was good
    std::optional<RangeFailure> failure;
};

/// The whole header of a part as its lines say it, each field the last of its name.
struct PartHeader {
    std::string range;    // Content-Range
    std::string encoding; // Content-Encoding
    Identity identity;    // its size is that of the whole, of Content-Range

    /// Takes one line, with its name in any case; one that begins an answer forgets those before it.
    void take(std::string_view line);
};

/// The bytes first to last that `range`, a Content-Range, tells of, and of how many; nothing unless it is whole.
struct PartPlace {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::uint64_t of = 0;
};

std::optional<PartPlace> partPlace(const std::string& range);

/// Connections to a server, kept between requests. Safe from many threads at once, each of which has its own.
class Connections {
public:
    /// `address` is http:// or https://. Throws Error where the library is missing what it takes.
    Connections(std::string address, const Access& access);
    ~Connections();
    Connections(const Connections&) = delete;
    Connections& operator=(const Connections&) = delete;
    Connections(Connections&&) = delete;
    Connections& operator=(Connections&&) = delete;

    /// Fills `out` from `offset` of what lies there, which has to be `known`; while that is not known, there may be
    /// less than `out` has room for. Takes no more than that of whatever the server sends.
    RangeAnswer get(std::uint64_t offset, std::span<std::byte> out, const Identity* known) const;

    /// Ends requests that wait, now and from now on.
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
    mutable std::string redirectedTo_; // the host that sent the last part, if that was another than the address's
    mutable std::atomic<bool> isStopped_{false};
};

} // namespace gnomon::storage
