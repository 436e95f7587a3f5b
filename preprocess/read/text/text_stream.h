// Reads a text file word by word and line by line. The readers of OBJ, OFF and ASCII STL use it.
#pragma once

#include "preprocess/read/byte_stream.h"

#include <string>
#include <string_view>

namespace gnomon::read {

/// Throws Error, which names the encoding, if the text in `file` looks like UTF-16 or UTF-32, with or without a byte
/// order mark. Each reader of a text format calls this function first.
void requireUtf8(const InputFile& file);

/// Returns the length in bytes of the UTF-8 byte order mark at the start of `file`, which is 3 or 0.
std::uint64_t markBytesOf(const InputFile& file);

/// Reads the words of a text file from start to end. The memory is constant for any length of the file and of its
/// lines. Lines end with LF, CR LF, or CR (old Mac files).
class TextStream {
public:
    /// The syntax of a text format: whether it has comments and joined lines.
    struct Rules {
        bool hasComments = false;   ///< a '#' begins a comment, except after a '.' (see numberIn)
        bool isContinuable = false; ///< a backslash at the end of a line joins it with the next line
    };

    /// The max length of a number or keyword, in characters. Longer words are returned in several pieces.
    static constexpr std::size_t kLongestWord = 1000;

    /// Opens `file` for reading. Throws Error for text in UTF-16 or UTF-32.
    TextStream(const InputFile& file, const Rules& rules);

    /// Skips the rest of the current line and its line end.
    void endLine();

    /// Skips the rest of the current line and goes to the next line. Returns false at the end of the file.
    bool nextLine();

    /// Returns the next word of the current line, or an empty word at the end of the line. The result is valid until
    /// the next call.
    std::string_view word() {
        if (plainEnd_ == nullptr) return wordOfAnyLine();
        while (at_ != plainEnd_ && isBlank(*at_))
            ++at_;
        const char* const begin = at_;
        while (at_ != plainEnd_ && !isBlank(*at_))
            ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    /// Returns the next word of the file, on this line or a later line. Returns an empty word at the end of the file.
    std::string_view wordOnAnyLine();

    /// Throws Error if `word` has more than kLongestWord characters. Such a word is neither a number nor a keyword.
    void requireShort(std::string_view word) const;

    /// Converts the text `word` to a number, which may be infinite or NaN. Throws Error if the word is not a number, or
    /// if the number is too large for a double.
    double numberOf(std::string_view word) const;

    /// Returns the rest of the current line including comments, without blanks at both ends. Lines that a backslash
    /// joins count as one line. Throws Error if the text is longer than 1 MiB.
    std::string rest();

    /// Moves forward to the byte position `offset`, which must be the start of a line. `lines` is the number of lines
    /// before it.
    void moveTo(std::uint64_t offset, std::uint64_t lines);

    /// Returns the current position in bytes from the start of the file.
    std::uint64_t offset() const { return stream_.offset() + static_cast<std::uint64_t>(at_ - begin_); }

    /// Returns true if the current position is inside a line, before the characters that end the line.
    bool isInLine() const { return !isBehindLine_; }

    /// Returns the number of the current line, counted from 1.
    std::uint64_t line() const { return line_; }

    /// Returns the place "PATH:LINE" of the current line, for error messages.
    std::string where() const;

private:
    static constexpr bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    /// Returns true if the last non-blank character of the text is a backslash. Returns `before` if the text is blank.
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
    const char* begin_ = nullptr; // start of the bytes in memory
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    const char* plainEnd_ = nullptr; // end of the line if it is plain (see findPlainEnd); otherwise null
    bool isLast_ = false;            // whether the bytes in memory reach the end of the file
    bool isBehindLine_ = true;       // whether the current line and its line end were consumed
    std::uint64_t line_ = 0;
    std::string held_; // copy of a word whose bytes are no longer in memory
};

} // namespace gnomon::read
