// The interface through which the bytes of a model are read from a file or a web server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// Tells whether the content of a file or web address is unchanged, changed or gone since it was opened.
enum class Fate : std::uint8_t { Same, Changed, Gone };

/// The bytes of a model, in a file or on a web server. Their number is fixed when the source is opened. Many threads
/// can read at the same time.
class Source {
public:
    Source() = default;
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    Source(Source&&) = delete;
    Source& operator=(Source&&) = delete;

    /// Returns the name of the source for messages: a path, or a web address without passwords and query.
    virtual const std::string& name() const = 0;

    virtual std::uint64_t size() const = 0;

    /// Fills `out` with the bytes from `offset`. Retries after temporary failures. Throws Error if reading fails or if
    /// the content is too short.
    virtual void readAt(std::uint64_t offset, std::span<std::byte> out) const = 0;

    /// Reads bytes again without using caches, for example after a checksum error. Returns false if the source has no
    /// cache.
    virtual bool readAnew(std::uint64_t offset, std::span<std::byte> out) const = 0;

    virtual Fate fate() const = 0;

    /// Returns a text that changes whenever the content changes. The text contains the size and the date or tag of the
    /// content.
    virtual std::string stamp() const = 0;

    /// Returns the number of parallel reads that is useful for speed.
    virtual unsigned parallelReads() const = 0;

    /// Returns true if the bytes come from a server, so that a failed read may succeed later without an action of the
    /// user.
    virtual bool isRemote() const = 0;

    /// Ends all waiting reads from the source. They throw Error, and so do all later reads.
    virtual void stop() const = 0;
};

} // namespace gnomon::hierarchy
