// Reads the bytes of a model from a web server by byte ranges.
#pragma once

#include "hierarchy/source/access.h"
#include "hierarchy/source/range_cache.h"
#include "hierarchy/source/range_request.h"
#include "hierarchy/source/source.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

namespace gnomon::hierarchy {

/// A model file at a web address. The server must support byte ranges (RFC 9110, section 14). A cache on disk stores
/// the received ranges. The start and the end of the file, which contain the model's header and tables, are read with
/// one request each.
class HttpSource final : public Source {
public:
    /// Requests the start of the file at `address`. Throws Error if the server does not deliver byte ranges.
    HttpSource(const std::string& address, const Access& access);

    const std::string& name() const override { return name_; }

    std::uint64_t size() const override { return identity_.size; }

    void readAt(std::uint64_t offset, std::span<std::byte> out) const override;

    bool readAnew(std::uint64_t offset, std::span<std::byte> out) const override;

    /// Returns whether the content is unchanged, according to the last answer of the server.
    Fate fate() const override { return fate_; }

    std::string stamp() const override;

    unsigned parallelReads() const override { return 8; } // parallel requests hide the latency of the server

    bool isRemote() const override { return true; }

    void stop() const override;

private:
    void open(std::chrono::milliseconds retryTime);
    void fetch(std::uint64_t offset, std::span<std::byte> out) const;
    bool waitFor(std::chrono::milliseconds pause) const;
    std::uint64_t tailOffset() const;
    void readTail(std::uint64_t offset, std::span<std::byte> out) const;
    void takeTail(std::vector<std::byte> tail, std::uint64_t offset, std::span<std::byte> out) const;
    void copyTail(std::uint64_t offset, std::span<std::byte> out) const;
    void fetchKept(std::uint64_t offset, std::span<std::byte> out) const;
    void readKept(std::uint64_t offset, std::span<std::byte> out) const;

    std::string name_;
    Access access_;
    Connections connections_;
    Identity identity_;
    std::vector<std::byte> head_;
    std::optional<RangeCache> cache_;
    mutable std::atomic<Fate> fate_{Fate::Same};
    mutable std::mutex mutex_; // protects the following members
    mutable std::condition_variable stopped_;
    mutable std::vector<std::byte> tail_; // empty until its first use
};

} // namespace gnomon::hierarchy
