// Writes values to a file through a large buffer.
#pragma once

#include "core/file.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::exporter {

/// A buffered writer of values that starts at the beginning of the file. The caller must call `flush` at the end to
/// write the rest of the buffer.
class RunWriter {
public:
    explicit RunWriter(File& file) : file_(file) {}

    void put(std::string_view text) { append(text.data(), text.size()); }

    template <class T>
    void putValue(T value) {
        append(&value, sizeof(T));
    }

    void flush() {
        file_.writeAt(offset_, buffer_);
        offset_ += buffer_.size();
        buffer_.clear();
    }

private:
    void append(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const std::byte*>(data);
        buffer_.insert(buffer_.end(), bytes, bytes + size);
        constexpr std::size_t kRunBytes = std::size_t{1} << 20U;
        if (buffer_.size() >= kRunBytes) flush();
    }

    File& file_;
    std::uint64_t offset_ = 0;
    std::vector<std::byte> buffer_;
};

} // namespace gnomon::exporter
