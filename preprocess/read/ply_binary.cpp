#include "core/error.h"
#include "preprocess/read/ply_values.h"

#include <bit>
#include <cmath>

namespace gnomon::preprocess {

namespace {

constexpr PlyFormat kNativeFormat =
    std::endian::native == std::endian::little ? PlyFormat::BinaryLittleEndian : PlyFormat::BinaryBigEndian;

} // namespace

BinaryValues::BinaryValues(const File& file, PlyFormat format, PlyPlace start)
    : stream_(file, start.offset), isSwapped_(format != kNativeFormat) {}

void BinaryValues::skip(PlyType type, std::uint64_t count) {
    skipRows(byteSize(type), count);
}

void BinaryValues::skipRows(std::uint64_t rowBytes, std::uint64_t count) {
    if (rowBytes == 0) return;
    if (count > stream_.remaining() / rowBytes) throwEndsEarly();
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
    throw Error(atByte(stream_.path(), stream_.offset() + stream_.remaining()), "the file ends too early");
}

std::int64_t BinaryValues::wholeNumber(double value) const {
    constexpr double kLimit = 0x1.0p53;
    if (!(std::abs(value) < kLimit) || value != std::floor(value)) throw Error(where(), "not a whole number");
    return static_cast<std::int64_t>(value);
}

std::string BinaryValues::where() const {
    return atByte(stream_.path(), lastOffset_);
}

} // namespace gnomon::preprocess
