// The interface that reads the bytes of a model from a file or a server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// The state of the content of a source, compared with the content when it was opened.
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

    /// Returns the name of the source for messages: a path, or an address without passwords and query.
    virtual const std::string& name() const = 0;

    virtual std::uint64_t size() const = 0;

    /// Fills `out` with the bytes from `offset`. Retries after temporary failures. Throws Error if reading fails or the
    /// content is too short.
    virtual void readAt(std::uint64_t offset, std::span<std::byte> out) const = 0;

    /// Reads bytes again without caches, for example after a checksum error. Returns false if the source has no cache.
    virtual bool readAnew(std::uint64_t offset, std::span<std::byte> out) const = 0;

    virtual Fate fate() const = 0;

    /// Returns a text that changes if the content changes. It contains the size and the date or the tag.
    virtual std::string stamp() const = 0;

    /// Returns how many parallel reads are useful.
    virtual unsigned parallelReads() const = 0;

    /// Returns true if a failed read may succeed later without an action of the user.
    virtual bool isRemote() const = 0;

    /// Ends all waiting reads. These reads and all later reads throw Error.
    virtual void stop() const = 0;
};

} // namespace gnomon::hierarchy
