// The values of a PLY body one after the other, from bytes or from text, behind the same calls.
#pragma once

#include "preprocess/read/byte_stream.h"
#include "preprocess/read/ply/ply_header.h"

#include <cstring>
#include <string>
#include <string_view>

namespace gnomon::read {

/// Where a pass may begin again.
struct PlyPlace {
    std::uint64_t offset = 0; ///< bytes
    std::uint64_t line = 1;   ///< ascii only
};

/// How far a pass is in the element that it reads, for errors.
struct PlyProgress {
    std::string element;
    std::uint64_t rows = 0; ///< that the header promises
    std::uint64_t done = 0; ///< that were whole

    /// The row that is being read.
    std::string row() const;

    /// Of a file that ends inside the element.
    [[noreturn]] void throwEndsEarly(const std::string& where) const;
};

/// A value of type T from unaligned bytes, its bytes reversed if `isSwapped`.
template <class T>
T loadValue(const std::byte* bytes, bool isSwapped) {
    T value;
    if (!isSwapped) {
        std::memcpy(&value, bytes, sizeof(T));
    } else {
        std::byte reversed[sizeof(T)];
        for (std::size_t i = 0; i < sizeof(T); ++i)
            reversed[i] = bytes[sizeof(T) - 1 - i];
        std::memcpy(&value, reversed, sizeof(T));
    }
    return value;
}

/// Calls `use` with the value of `type` at `bytes`, in its own C++ type.
template <class Use>
auto withValue(PlyType type, const std::byte* bytes, bool isSwapped, Use use) {
    switch (type) {
    case PlyType::Int8:
        return use(loadValue<std::int8_t>(bytes, isSwapped));
    case PlyType::Uint8:
        return use(loadValue<std::uint8_t>(bytes, isSwapped));
    case PlyType::Int16:
        return use(loadValue<std::int16_t>(bytes, isSwapped));
    case PlyType::Uint16:
        return use(loadValue<std::uint16_t>(bytes, isSwapped));
    case PlyType::Int32:
        return use(loadValue<std::int32_t>(bytes, isSwapped));
    case PlyType::Uint32:
        return use(loadValue<std::uint32_t>(bytes, isSwapped));
    case PlyType::Float32:
        return use(loadValue<float>(bytes, isSwapped));
    case PlyType::Float64:
        break;
    }
    return use(loadValue<double>(bytes, isSwapped));
}

/// The values of a binary body. Every call throws Error with the byte offset where the file ends too early.
class BinaryValues {
public:
    BinaryValues(const InputFile& file, PlyFormat format, PlyPlace start);

    double real(PlyType type) {
        return withValue(type, take(byteSize(type)), isSwapped_, [](auto value) { return static_cast<double>(value); });
    }

    /// A count or an index; a float is one only if it is whole.
    std::int64_t integer(PlyType type) {
        if (isFloat(type)) return wholeNumber(real(type));
        return withValue(
            type, take(byteSize(type)), isSwapped_, [](auto value) { return static_cast<std::int64_t>(value); });
    }

    void skip(PlyType type, std::uint64_t count = 1);

    /// Passes over `count` rows of `rowBytes` bytes, which the file must still have.
    void skipRows(std::uint64_t rowBytes, std::uint64_t count);

    /// What is read from here on is the rows of `element` from `row` on.
    void beginElement(const PlyElement& element, std::uint64_t row = 0) {
        progress_ = {element.name, element.count, row};
    }

    void endRow() { ++progress_.done; }

    void endRows(std::uint64_t count) { progress_.done += count; }

    /// The most values of `type` that the rest of the file can hold.
    std::uint64_t mostValues(PlyType type) const { return stream_.remaining() / byteSize(type); }

    /// The value read last, for errors.
    std::string where() const;

    std::string row() const { return progress_.row(); }

    PlyPlace place() const { return {stream_.offset(), 0}; }

    /// Throws Error if anything but blanks or zeros follows the last element.
    void expectEnd();

    ByteStream& stream() { return stream_; }

    bool isSwapped() const { return isSwapped_; }

    [[noreturn]] void throwEndsEarly() const;

private:
    const std::byte* take(std::size_t count) {
        if (!stream_.fill(count)) throwEndsEarly();
        lastOffset_ = stream_.offset();
        const std::byte* bytes = stream_.data();
        stream_.consume(count);
        return bytes;
    }

    std::int64_t wholeNumber(double value) const;

    ByteStream stream_;
    bool isSwapped_;
    std::uint64_t lastOffset_ = 0;
    PlyProgress progress_;
};

/// The values of an ascii body: words between blanks and line ends. A row may wrap, but the next begins on a new line.
/// A value is rounded to its declared type, so that the same mesh in ascii and in binary is the same mesh.
class AsciiValues {
public:
    AsciiValues(const InputFile& file, char lineEnd, PlyPlace start);

    double real(PlyType type);
    std::int64_t integer(PlyType type);
    void skip(PlyType type, std::uint64_t count = 1);
    void skipRows(std::uint64_t valuesPerRow, std::uint64_t count);

    void beginElement(const PlyElement& element, std::uint64_t row = 0) {
        progress_ = {element.name, element.count, row};
    }

    void endRow();
    std::uint64_t mostValues(PlyType type) const;
    std::string where() const;

    std::string row() const { return progress_.row(); }

    /// The number that `real` read last, as text; valid until the next call of another function.
    std::string_view lastWord() const { return lastWord_; }

    PlyPlace place() const { return {stream_.offset(), line_}; }

    void expectEnd();

private:
    std::string_view word();
    bool skipBlanks(bool acrossLines);

    ByteStream stream_;
    char lineEnd_;
    std::uint64_t line_;
    std::string_view lastWord_;
    PlyProgress progress_;
};

} // namespace gnomon::read
