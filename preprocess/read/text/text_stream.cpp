#include "preprocess/read/text/text_stream.h"

#include "core/error.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::read {

namespace {

constexpr std::size_t kLongestRest = std::size_t{1} << 20U;

using EndsWord = std::array<bool, 256>;

constexpr EndsWord endsWordTable(bool hasComments) {
    EndsWord table{};
    for (std::size_t c = 0; c < table.size(); ++c)
        table[c] = c == ' ' || (c >= '\t' && c <= '\r') || (hasComments && c == '#');
    return table;
}

constexpr EndsWord kEndsWord = endsWordTable(false);
constexpr EndsWord kEndsWordOrBeginsComment = endsWordTable(true);

/// Returns true if `bytes` look like ASCII text in units of `width` bytes, such as UTF-16. Only the byte number
/// `significant` of each unit may be nonzero.
bool areWide(std::span<const std::byte> bytes, std::size_t width, std::size_t significant) {
    constexpr std::size_t kUnits = 4;
    if (bytes.size() < width * kUnits) return false;
    for (std::size_t i = 0; i < width * kUnits; ++i) {
        const auto value = std::to_integer<unsigned>(bytes[i]);
        const bool isText = (value >= ' ' && value <= '~') || (value >= '\t' && value <= '\r');
        if (i % width == significant ? !isText : value != 0) return false;
    }
    return true;
}

bool beginsWithMark(std::span<const std::byte> bytes, std::initializer_list<unsigned> mark) {
    return bytes.size() >= mark.size() &&
           std::equal(mark.begin(), mark.end(), bytes.begin(), [](unsigned a, std::byte b) {
               return a == std::to_integer<unsigned>(b);
           });
}

} // namespace

void requireUtf8(const InputFile& file) {
    std::array<std::byte, 16> head{};
    const std::span<const std::byte> bytes = std::span(head).first(file.readSomeAt(0, head));
    const bool isUtf32 = beginsWithMark(bytes, {0xFF, 0xFE, 0, 0}) || beginsWithMark(bytes, {0, 0, 0xFE, 0xFF}) ||
                         areWide(bytes, 4, 0) || areWide(bytes, 4, 3);
    const bool isUtf16 = beginsWithMark(bytes, {0xFF, 0xFE}) || beginsWithMark(bytes, {0xFE, 0xFF}) ||
                         areWide(bytes, 2, 0) || areWide(bytes, 2, 1);
    if (isUtf32) throw Error(file.path(), "the text is in UTF-32; convert to UTF-8");
    if (isUtf16) throw Error(file.path(), "the text is in UTF-16; convert to UTF-8");
}

std::uint64_t markBytesOf(const InputFile& file) {
    std::array<std::byte, 3> head{};
    const std::span<const std::byte> bytes = std::span(head).first(file.readSomeAt(0, head));
    return beginsWithMark(bytes, {0xEF, 0xBB, 0xBF}) ? 3 : 0;
}

TextStream::TextStream(const InputFile& file, const Rules& rules) : stream_(file, markBytesOf(file)), rules_(rules) {
    requireUtf8(file);
    refill();
    const auto size = static_cast<std::size_t>(end_ - at_);
    if (size > 0 && std::memchr(at_, '\n', size) == nullptr && std::memchr(at_, '\r', size) != nullptr) lineEnd_ = '\r';
}

std::string TextStream::where() const {
    return atLine(stream_.path(), line_);
}

/// Reads more of the file until more than kLongestWord bytes after the current position are in memory, or the file
/// ends. Returns false if the current position is the end of the file.
bool TextStream::refill() {
    stream_.consume(static_cast<std::size_t>(at_ - begin_));
    stream_.fill(kLongestWord + 1);
    begin_ = at_ = reinterpret_cast<const char*>(stream_.data());
    end_ = begin_ + stream_.available();
    isLast_ = stream_.remaining() == stream_.available();
    return at_ != end_;
}

/// Skips blanks up to the next word of the current line. Returns false at the end of the line.
bool TextStream::skipBlanks() {
    if (isBehindLine_) return false;
    while (true) {
        while (at_ != end_ && isBlank(*at_) && *at_ != lineEnd_)
            ++at_;
        if (static_cast<std::size_t>(end_ - at_) > kLongestWord || isLast_) return at_ != end_ && *at_ != lineEnd_;
        refill();
    }
}

std::string_view TextStream::wordOfAnyLine() {
    while (skipBlanks()) {
        if (rules_.hasComments && *at_ == '#') {
            skipToLineEnd();
            return {};
        }
        const EndsWord& endsWord = rules_.hasComments ? kEndsWordOrBeginsComment : kEndsWord;
        const char* const begin = at_;
        const char* const limit =
            begin + std::min<std::size_t>(static_cast<std::size_t>(end_ - begin), kLongestWord + 1);
        while (at_ != limit && (!endsWord[static_cast<unsigned char>(*at_)] || (*at_ == '#' && at_[-1] == '.')))
            ++at_;
        std::string_view found(begin, static_cast<std::size_t>(at_ - begin));
        if (!rules_.isContinuable || found.back() != '\\') return found;
        found = continued(found);
        if (!found.empty()) return found;
    }
    return {};
}

/// Processes `word`, which ends with a backslash, and returns it. If the line ends after the word, the function removes
/// the backslash and goes to the next line.
std::string_view TextStream::continued(std::string_view word) {
    held_ = word;
    if (skipBlanks()) return held_;
    held_.pop_back();
    joinNextLine();
    return held_;
}

/// Goes from the end of the current line to the start of the next line, after a backslash has joined both lines.
void TextStream::joinNextLine() {
    if (at_ != end_) ++at_;
    if (at_ == end_ && !refill()) throw Error(where(), "the file ends inside a continued line");
    ++line_;
}

bool TextStream::endsInBackslash(const char* begin, const char* end, bool before) {
    while (end != begin && isBlank(end[-1]))
        --end;
    return end != begin ? end[-1] == '\\' : before;
}

/// Goes to the end of the current line. Returns true if its last non-blank character is a backslash outside a comment,
/// so that the next line continues it.
bool TextStream::skipToLineEnd() {
    bool hasComment = at_ != end_ && *at_ == '#';
    bool isContinued = false;
    while (at_ != end_ || refill()) {
        const auto size = static_cast<std::size_t>(end_ - at_);
        const auto* const found = static_cast<const char*>(std::memchr(at_, lineEnd_, size));
        const char* const stop = found != nullptr ? found : end_;
        if (rules_.isContinuable) {
            isContinued = endsInBackslash(at_, stop, isContinued);
            if (isContinued || found == nullptr) hasComment = hasComment || std::find(at_, stop, '#') != stop;
        }
        at_ = stop;
        if (found != nullptr) break;
    }
    return isContinued && !hasComment;
}

void TextStream::endLine() {
    if (isBehindLine_) return;
    if (plainEnd_ != nullptr)
        at_ = plainEnd_;
    else
        while (skipToLineEnd())
            joinNextLine();
    plainEnd_ = nullptr;
    if (at_ != end_) ++at_;
    isBehindLine_ = true;
}

bool TextStream::nextLine() {
    endLine();
    if (static_cast<std::size_t>(end_ - at_) <= kLongestWord && !isLast_) refill();
    if (at_ == end_) return false;
    isBehindLine_ = false;
    ++line_;
    findPlainEnd();
    return true;
}

/// Sets `plainEnd_` to the end of the current line if the line is plain: completely in memory, without a comment, and
/// without a backslash that joins it to the next line. The words of a plain line can be read without a copy.
void TextStream::findPlainEnd() {
    const auto* const found =
        static_cast<const char*>(std::memchr(at_, lineEnd_, static_cast<std::size_t>(end_ - at_)));
    if (found == nullptr) return;
    const auto size = static_cast<std::size_t>(found - at_);
    if (rules_.hasComments && std::memchr(at_, '#', size) != nullptr) return;
    const char* last = found;
    while (rules_.isContinuable && last != at_ && isBlank(last[-1]))
        --last;
    if (rules_.isContinuable && last != at_ && last[-1] == '\\') return;
    plainEnd_ = found;
}

std::string_view TextStream::wordOnAnyLine() {
    while (true) {
        const std::string_view found = word();
        if (!found.empty() || !nextLine()) return found;
    }
}

void TextStream::requireShort(std::string_view word) const {
    if (word.size() > kLongestWord)
        throw Error(where(), "a word is longer than 1000 characters", "a number or a keyword", quotedForMessage(word));
}

double TextStream::numberOf(std::string_view word) const {
    requireShort(word);
    const std::optional<double> value = numberIn(word);
    if (!value) throw Error(where(), "not a number", "a number", quotedForMessage(word));
    if (isHugeNumber(word, *value))
        throw Error(
            where(), "the number is too large", "at most 1.79e308, the maximum of a double", quotedForMessage(word));
    return *value;
}

/// Appends the bytes from the current position to the end of the line to `text`.
void TextStream::appendLine(std::string& text) {
    while (at_ != end_ || refill()) {
        const auto* const found =
            static_cast<const char*>(std::memchr(at_, lineEnd_, static_cast<std::size_t>(end_ - at_)));
        const char* const stop = found != nullptr ? found : end_;
        if (text.size() + static_cast<std::size_t>(stop - at_) > kLongestRest)
            throw Error(where(), "a line of names is longer than 1 MiB");
        text.append(at_, stop);
        at_ = stop;
        if (found != nullptr) return;
    }
}

std::string TextStream::rest() {
    std::string text;
    plainEnd_ = nullptr; // null makes skipBlanks and appendLine read the rest of this line
    while (skipBlanks()) {
        appendLine(text);
        while (!text.empty() && isBlank(text.back()))
            text.pop_back();
        if (!rules_.isContinuable || !text.ends_with('\\')) return text;
        text.pop_back();
        text.resize(text.find_last_not_of(" \t\r\v\f") + 1);
        text += ' ';
        joinNextLine();
    }
    return text;
}

void TextStream::moveTo(std::uint64_t offset, std::uint64_t lines) {
    stream_.consume(static_cast<std::size_t>(at_ - begin_));
    stream_.skip(offset - stream_.offset());
    begin_ = at_ = end_ = reinterpret_cast<const char*>(stream_.data());
    plainEnd_ = nullptr;
    isLast_ = false;
    isBehindLine_ = true;
    line_ = lines;
}

} // namespace gnomon::read
