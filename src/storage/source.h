// The bytes of a model, wherever they lie: all that reads one reads through this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::storage {

/// What became of a source's content since it was opened.
enum class Fate : std::uint8_t { Same, Changed, Gone };

/// Bytes at offsets, of which there are as many as when it was opened. Safe from many threads at once.
class Source {
public:
    Source() = default;
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    Source(Source&&) = delete;
    Source& operator=(Source&&) = delete;

    /// What messages call it: a path, or an address without what it tells a server in secret.
    virtual const std::string& name() const = 0;

    virtual std::uint64_t size() const = 0;

    /// Fills `out` from `offset`, trying again where that may help. Throws Error if it cannot be read for now, or ends
    /// before.
    virtual void readAt(std::uint64_t offset, std::span<std::byte> out) const = 0;

    /// The same where what `readAt` gave is not what was written, from behind all caches; false if there are none.
    virtual bool readAnew(std::uint64_t offset, std::span<std::byte> out) const = 0;

    virtual Fate fate() const = 0;

    /// What changes with the content: its size, and when or as what it was written.
    virtual std::string stamp() const = 0;

    /// How many reads at a time are worth it.
    virtual unsigned parallelReads() const = 0;

    /// Whether what could not be read may come later, without a person's doing.
    virtual bool isRemote() const = 0;

    /// Ends reads that wait: they and all later ones throw Error.
    virtual void stop() const = 0;
};

} // namespace gnomon::storage
