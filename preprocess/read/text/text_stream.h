// The words of a text file one after the other, line by line: what the readers of OBJ, OFF and ASCII STL share.
#pragma once

#include "preprocess/read/byte_stream.h"

#include <string>
#include <string_view>

namespace gnomon::read {

/// Throws Error that names the encoding if `file` begins as text in UTF-16 or UTF-32 does, with a byte order mark or
/// without. Each format of text calls this before it reads.
void requireUtf8(const InputFile& file);

/// Returns the bytes of a byte order mark of UTF-8 that `file` begins with: 3, or 0 for none.
std::uint64_t markBytesOf(const InputFile& file);

/// A forward window over the words of a text. It holds one buffer, whatever the length of the file or of its lines.
/// Lines end with LF or CR LF, or with CR in files of the old Mac kind.
class TextStream {
public:
    /// The rules of a format.
    struct Rules {
        bool hasComments = false;   ///< a '#' begins a comment, except behind a '.' (see numberIn)
        bool isContinuable = false; ///< a backslash at the end of a line joins the next line
    };

    /// A longer word is no number and no keyword; it comes in pieces.
    static constexpr std::size_t kLongestWord = 1000;

    /// Throws Error for text that is not UTF-8.
    TextStream(const InputFile& file, const Rules& rules);

    /// Goes to the end of the line in hand, behind which the next line begins.
    void endLine();

    /// Goes to the next line; the rest of the line in hand is skipped. False at the end of the file.
    bool nextLine();

    /// Returns the next word of the line, empty at its end. Valid until the next call.
    std::string_view word() {
        if (plainEnd_ == nullptr) return wordOfAnyLine();
        while (at_ != plainEnd_ && isBlank(*at_))
            ++at_;
        const char* const begin = at_;
        while (at_ != plainEnd_ && !isBlank(*at_))
            ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    /// Returns the next word of this or a later line, empty at the end of the file.
    std::string_view wordOnAnyLine();

    /// Throws Error for a word of more than kLongestWord characters, which is neither a number nor a keyword.
    void requireShort(std::string_view word) const;

    /// Returns the number that `word` is, finite or not. Throws Error for a word that is no number, and for a number
    /// that is too large for a double.
    double numberOf(std::string_view word) const;

    /// Returns the rest of the line in hand, without the blanks around it and with its comments. Throws Error for more
    /// than 1 MiB.
    std::string rest();

    /// Moves forward to a place where a line begins. `lines` are before it.
    void moveTo(std::uint64_t offset, std::uint64_t lines);

    /// The bytes from the start of the file to the current place.
    std::uint64_t offset() const { return stream_.offset() + static_cast<std::uint64_t>(at_ - begin_); }

    /// Whether a line is in hand, whose end is not passed.
    bool isInLine() const { return !isBehindLine_; }

    /// The number of the line in hand.
    std::uint64_t line() const { return line_; }

    /// "PATH:LINE" of the line in hand.
    std::string where() const;

private:
    static constexpr bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    /// Returns whether the last character of a text that is not blank is a backslash. A blank text returns `before`.
    static bool endsInBackslash(const char* begin, const char* end, bool before);

    std::string_view wordOfAnyLine();
    void findPlainEnd();
    bool refill();
    bool skipBlanks();
    bool skipToLineEnd();
    void joinNextLine();
    void appendLine(std::string& text);
    std::string_view continued(std::string_view word);

    ByteStream stream_;
    Rules rules_;
    char lineEnd_ = '\n';
    const char* begin_ = nullptr; // of the window
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    const char* plainEnd_ = nullptr; // of a line that the window has, without comments and continuation; else null
    bool isLast_ = false;            // the window has the end of the file
    bool isBehindLine_ = true;       // the line in hand is over, and its end is consumed
    std::uint64_t line_ = 0;
    std::string held_; // a word whose place in the window is lost
};

} // namespace gnomon::read
