#include "core/error.h"
#include "preprocess/read/ply/ply_values.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::read {

namespace {

constexpr PlyFormat kNativeFormat =
    std::endian::native == std::endian::little ? PlyFormat::BinaryLittleEndian : PlyFormat::BinaryBigEndian;

} // namespace

std::string PlyProgress::row() const {
    return "row " + std::to_string(done + 1) + " of " + std::to_string(rows) + " of element \"" + element + "\"";
}

void PlyProgress::throwEndsEarly(const std::string& where) const {
    throw Error(
        where,
        "the file ends too early",
        std::to_string(rows) + " rows of element \"" + element + "\"",
        std::to_string(done));
}

BinaryValues::BinaryValues(const InputFile& file, PlyFormat format, PlyPlace start)
    : stream_(file, start.offset), isSwapped_(format != kNativeFormat) {}

void BinaryValues::skip(PlyType type, std::uint64_t count) {
    if (count > maxValues(type)) throwEndsEarly();
    stream_.skip(byteSize(type) * count);
}

void BinaryValues::skipRows(std::uint64_t rowBytes, std::uint64_t count) {
    if (rowBytes == 0) return;
    const std::uint64_t whole = std::min(count, stream_.remaining() / rowBytes);
    endRows(whole);
    if (whole < count) throwEndsEarly();
    stream_.skip(rowBytes * count);
}

void BinaryValues::expectEnd() {
    while (stream_.fill(1)) {
        for (std::size_t i = 0; i < stream_.available(); ++i) {
            const auto c = static_cast<char>(stream_.data()[i]);
            if (c != '\0' && c != ' ' && c != '\n' && c != '\r' && c != '\t')
                throw Error(
                    atByte(stream_.path(), stream_.offset() + i),
                    "data after the last element: the header's counts are too small");
        }
        stream_.consume(stream_.available());
    }
}

void BinaryValues::throwEndsEarly() const {
    progress_.throwEndsEarly(atByte(stream_.path(), stream_.offset() + stream_.remaining()));
}

std::int64_t BinaryValues::wholeNumber(double value) const {
    constexpr double kLimit = 0x1.0p53;
    if (!(std::abs(value) < kLimit) || value != std::floor(value)) throw Error(where(), "not a whole number");
    return static_cast<std::int64_t>(value);
}

std::string BinaryValues::where() const {
    return atByte(stream_.path(), lastOffset_);
}

} // namespace gnomon::read
