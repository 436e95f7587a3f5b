// Byte streams in little-endian order: a writer with a growing buffer, and a reader that never reads past the end.
#pragma once

#include "core/error.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::hierarchy {

static_assert(std::endian::native == std::endian::little, "a .gnm is little-endian and copied as it is");

/// The exception for invalid stored bytes. The code that reads the file converts it to an Error with path and offset.
struct Damage {
    std::string what;
};

/// A writer that appends values to a growing array of bytes.
class ByteWriter {
public:
    template <class T>
    requires std::is_arithmetic_v<T>

    void put(const T& value) {
        if constexpr (sizeof(T) == 1) {
            bytes_.push_back(static_cast<std::byte>(value));
        } else {
            const auto* raw = reinterpret_cast<const std::byte*>(&value);
            bytes_.insert(bytes_.end(), raw, raw + sizeof(T));
        }
    }

    /// Appends `value` as a varint (variable-length integer): seven bits per byte, low bits first, in 1 to 10 bytes.
    void putVarint(std::uint64_t value) {
        while (value >= 0x80U) {
            put(static_cast<std::uint8_t>(value | 0x80U));
            value >>= 7U;
        }
        put(static_cast<std::uint8_t>(value));
    }

    void put(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    void putText(const std::string& text) {
        putVarint(text.size());
        put(std::as_bytes(std::span(text)));
    }

    /// Appends `count` bytes and returns a span of them, which the caller must fill before the next call.
    std::span<std::byte> room(std::size_t count) {
        bytes_.resize(bytes_.size() + count);
        return std::span(bytes_).last(count);
    }

    std::size_t size() const { return bytes_.size(); }

    const std::vector<std::byte>& bytes() const { return bytes_; }

    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

/// A reader that decodes values one after the other. It throws Damage if there are not enough bytes.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <class T>
    T take() {
        static_assert(std::is_arithmetic_v<T>);
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }

    std::uint64_t takeVarint() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 64; shift += 7) {
            const auto byte = take<std::uint8_t>();
            value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
            if (byte < 0x80U) return value;
        }
        throw Damage{"a number has more than 64 bits"};
    }

    std::span<const std::byte> take(std::size_t count) {
        if (count > rest_.size()) throw Damage{"the bytes end too early"};
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }

    std::string takeText() {
        const std::uint64_t length = takeVarint();
        const auto raw = take(length);
        return {reinterpret_cast<const char*>(raw.data()), raw.size()};
    }

    std::size_t remaining() const { return rest_.size(); }

    /// Throws Damage if unread bytes remain.
    void expectEnd() const {
        if (!rest_.empty()) throw Damage{std::to_string(rest_.size()) + " bytes too many"};
    }

private:
    std::span<const std::byte> rest_;
};

} // namespace gnomon::hierarchy
