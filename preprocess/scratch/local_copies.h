// Copies on this host of what was read of a shared folder: what is read again asks nothing of the network.
#pragma once

#include "core/file.h"

#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace gnomon::scratch {

/// Safe from many threads. Only whole pieces are found again, as they were kept.
class LocalCopies {
public:
    /// In a file of `folder` that has no name, so it goes with this process, however that ends. Throws Error.
    explicit LocalCopies(const std::string& folder);

    /// Fills `out` with the copy of what lies at `place`; false if there is none of that size.
    bool read(std::uint64_t place, std::span<std::byte> out) const;

    /// Keeps a copy. Where the disk is full there are no more copies, and that is all.
    void keep(std::uint64_t place, std::span<const std::byte> bytes);

    /// Forgets all, and gives the space back.
    void clear();

private:
    struct Copy {
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0;
    };

    File file_;
    mutable std::mutex mutex_;
    std::map<std::uint64_t, Copy> copies_; // by place
    std::uint64_t end_ = 0;
    bool isFull_ = false;
};

} // namespace gnomon::scratch
