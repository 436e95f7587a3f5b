// The interface for reading the bytes of a model from a file or a server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// The state of a source's content compared with its state at opening.
enum class Fate : std::uint8_t { Same, Changed, Gone };

/// The bytes of a model. Their number is fixed when the source is opened. Many threads can read at the same time.
class Source {
public:
    Source() = default;
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    Source(Source&&) = delete;
    Source& operator=(Source&&) = delete;

    /// Returns the name for messages: a path, or an address without passwords and query.
    virtual const std::string& name() const = 0;

    virtual std::uint64_t size() const = 0;

    /// Fills `out` from `offset`, with retries for temporary failures. Throws Error if reading fails or the content is
    /// too short.
    virtual void readAt(std::uint64_t offset, std::span<std::byte> out) const = 0;

    /// Reads the bytes again without caches, for use after a checksum error. Returns false if the source has no cache.
    virtual bool readAnew(std::uint64_t offset, std::span<std::byte> out) const = 0;

    virtual Fate fate() const = 0;

    /// Returns a text that changes with the content: its size, and its date or tag.
    virtual std::string stamp() const = 0;

    /// Returns the useful number of parallel reads.
    virtual unsigned parallelReads() const = 0;

    /// Returns true if a failed read can succeed later without action by the user.
    virtual bool isRemote() const = 0;

    /// Ends waiting reads. They and all later reads throw Error.
    virtual void stop() const = 0;
};

} // namespace gnomon::hierarchy
