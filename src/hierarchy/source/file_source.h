// Reads the bytes of a model from a local file.
#pragma once

#include "core/file.h"
#include "hierarchy/source/source.h"

namespace gnomon::hierarchy {

class FileSource final : public Source {
public:
    /// Opens a local model file. Throws Error if there is no file at `path`.
    explicit FileSource(const std::string& path);

    const std::string& name() const override { return file_.path(); }

    std::uint64_t size() const override { return size_; }

    void readAt(std::uint64_t offset, std::span<std::byte> out) const override;

    bool readAnew(std::uint64_t /*offset*/, std::span<std::byte> /*out*/) const override { return false; }

    Fate fate() const override;

    std::string stamp() const override;

    unsigned parallelReads() const override { return 4; } // measured: 4 reads keep a disk busy while two threads decode

    bool isRemote() const override { return false; }

    void stop() const override {}

private:
    File file_;
    std::uint64_t size_;
    std::int64_t changed_;
};

} // namespace gnomon::hierarchy
