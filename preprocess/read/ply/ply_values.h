// Sequential readers for the values of a PLY file after its header. The readers for binary and ASCII files have the
// same interface.
#pragma once

#include "preprocess/read/byte_stream.h"
#include "preprocess/read/ply/ply_header.h"

#include <cstring>
#include <string>
#include <string_view>

namespace gnomon::read {

/// A position in a PLY file from which values can be read.
struct PlyPlace {
    std::uint64_t offset = 0; ///< bytes from the start of the file
    std::uint64_t line = 1;   ///< line number, only for ASCII files
};

/// Counts the rows of the current PLY element that were read, for error messages.
struct PlyProgress {
    std::string element;
    std::uint64_t rows = 0; ///< number of rows that the header declares
    std::uint64_t done = 0; ///< number of rows that were read completely

    /// Returns a text that names the current row by its number and its element.
    std::string row() const;

    /// Throws Error because the file ends before the last row of the element. `where` is the position of the file's
    /// end.
    [[noreturn]] void throwEndsEarly(const std::string& where) const;
};

/// Reads a value of type T from unaligned bytes. Reverses the byte order if `isSwapped` is true.
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

/// Decodes the value of the PLY type `type` at `bytes` and calls `use` with it. The argument has the C++ type that
/// corresponds to `type`.
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

/// Reads the values of a binary PLY file in order. Each function throws Error with the byte offset if the file ends too
/// early.
class BinaryValues {
public:
    BinaryValues(const InputFile& file, PlyFormat format, PlyPlace start);

    double real(PlyType type) {
        return withValue(type, take(byteSize(type)), isSwapped_, [](auto value) { return static_cast<double>(value); });
    }

    /// Reads the next value as a list length or an index. Throws Error if it is a float that is not a whole number.
    std::int64_t integer(PlyType type) {
        if (isFloat(type)) return wholeNumber(real(type));
        return withValue(
            type, take(byteSize(type)), isSwapped_, [](auto value) { return static_cast<std::int64_t>(value); });
    }

    void skip(PlyType type, std::uint64_t count = 1);

    /// Skips `count` rows of `rowBytes` bytes each. Throws Error if the file ends before.
    void skipRows(std::uint64_t rowBytes, std::uint64_t count);

    /// Tells the reader that the next value belongs to row `row` of `element`, for error messages.
    void beginElement(const PlyElement& element, std::uint64_t row = 0) {
        progress_ = {element.name, element.count, row};
    }

    void endRow() { ++progress_.done; }

    void endRows(std::uint64_t count) { progress_.done += count; }

    /// Returns how many values of `type` the rest of the file can contain at most.
    std::uint64_t maxValues(PlyType type) const { return stream_.remaining() / byteSize(type); }

    /// Returns the path and the byte offset of the last value, for error messages.
    std::string where() const;

    std::string row() const { return progress_.row(); }

    PlyPlace place() const { return {stream_.offset(), 0}; }

    /// Throws Error if the file contains bytes other than blanks or zeros after the last element.
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

/// Reads the values of an ASCII PLY file in order. Blanks and line ends separate the values. A row can span several
/// lines, but the next row begins on a new line. Each value is rounded to its declared type, so that an ASCII file and
/// a binary file of the same mesh give the same result.
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
    std::uint64_t maxValues(PlyType type) const;
    std::string where() const;

    std::string row() const { return progress_.row(); }

    /// Returns the text of the number that `real` read last. The text is valid until the next call of another function
    /// of this object.
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
