#include "core/error.h"
#include "preprocess/read/ply/ply_values.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::read {

namespace {

// The max length of a number in an ASCII PLY file, in characters. Longer words are rejected, because no sensible number
// is so long.
constexpr std::size_t kLongestWord = 1000;

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

} // namespace

AsciiValues::AsciiValues(const InputFile& file, char lineEnd, PlyPlace start)
    : stream_(file, start.offset), lineEnd_(lineEnd), line_(start.line) {}

std::string AsciiValues::where() const {
    return atLine(stream_.path(), line_);
}

bool AsciiValues::skipBlanks(bool acrossLines) {
    while (stream_.fill(1)) {
        const auto* text = reinterpret_cast<const char*>(stream_.data());
        const std::size_t size = stream_.available();
        std::size_t i = 0;
        for (; i < size && isBlank(text[i]) && (acrossLines || text[i] != lineEnd_); ++i)
            line_ += text[i] == lineEnd_ ? 1 : 0;
        stream_.consume(i);
        if (i < size) return true;
    }
    return false;
}

std::string_view AsciiValues::word() {
    if (!skipBlanks(true)) progress_.throwEndsEarly(where());
    // Near the end of the file, `fill` returns false because fewer bytes remain. Its result is therefore ignored. The
    // last word of a file needs no separator.
    stream_.fill(kLongestWord + 1);
    const auto* text = reinterpret_cast<const char*>(stream_.data());
    const std::size_t size = std::min(stream_.available(), kLongestWord + 1);
    std::size_t length = 0;
    while (length < size && !isBlank(text[length]))
        ++length;
    if (length > kLongestWord) throw Error(where(), "not a number: a word is longer than 1000 characters");
    stream_.consume(length);
    return {text, length};
}

double AsciiValues::real(PlyType type) {
    lastWord_ = word();
    const std::optional<double> value = numberIn(lastWord_);
    if (!value) throw Error(where(), "not a number", "a number", quotedForMessage(lastWord_));
    return type == PlyType::Float32 ? static_cast<double>(static_cast<float>(*value)) : *value;
}

std::int64_t AsciiValues::integer(PlyType /*type*/) {
    const std::string_view text = word();
    if (const auto value = integerIn<std::int64_t>(text)) return *value;
    const double number = numberIn(text).value_or(0.5);
    constexpr double kLimit = 0x1.0p53;
    if (std::abs(number) < kLimit && number == std::floor(number)) return static_cast<std::int64_t>(number);
    throw Error(where(), "not a whole number", "an index or a count", quotedForMessage(text));
}

void AsciiValues::skip(PlyType /*type*/, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i)
        word();
}

void AsciiValues::skipRows(std::uint64_t valuesPerRow, std::uint64_t count) {
    if (valuesPerRow == 0) return;
    for (std::uint64_t row = 0; row < count; ++row) {
        for (std::uint64_t i = 0; i < valuesPerRow; ++i)
            word();
        endRow();
    }
}

void AsciiValues::endRow() {
    if (skipBlanks(false) && *reinterpret_cast<const char*>(stream_.data()) != lineEnd_)
        throw Error(where(), "more values in a row than the header declares");
    ++progress_.done;
}

std::uint64_t AsciiValues::maxValues(PlyType /*type*/) const {
    return stream_.remaining() / 2 + 1;
}

void AsciiValues::expectEnd() {
    if (skipBlanks(true)) throw Error(where(), "data after the last element: the header's counts are too small");
}

} // namespace gnomon::read
