// Reads a text file word by word and line by line. The readers of OBJ, OFF and ASCII STL use it.
#pragma once

#include "preprocess/read/byte_stream.h"

#include <string>
#include <string_view>

namespace gnomon::read {

/// Throws Error, which names the encoding, if `file` begins like text in UTF-16 or UTF-32, with or without a byte order
/// mark. Each reader of a text format calls this function first.
void requireUtf8(const InputFile& file);

/// Returns the length in bytes of the UTF-8 byte order mark at the start of `file`: 3, or 0 if there is none.
std::uint64_t markBytesOf(const InputFile& file);

/// Reads the words of a text from start to end. The buffer has the same size for any length of the file and of its
/// lines. Lines end with LF, CR LF, or CR (old Mac files).
class TextStream {
public:
    /// The rules by which a format separates words.
    struct Rules {
        bool hasComments = false;   ///< a '#' begins a comment, except after a '.' (see numberIn)
        bool isContinuable = false; ///< a backslash at the end of a line joins it with the next line
    };

    /// The max length of a number or keyword, in characters. Longer words are returned in pieces.
    static constexpr std::size_t kLongestWord = 1000;

    /// Opens `file`. Throws Error for text in UTF-16 or UTF-32.
    TextStream(const InputFile& file, const Rules& rules);

    /// Skips the rest of the current line and its line end.
    void endLine();

    /// Goes to the next line and skips the rest of the current line. Returns false at the end of the file.
    bool nextLine();

    /// Returns the next word of the current line, or an empty word at the end of the line. The word is valid until the
    /// next call.
    std::string_view word() {
        if (plainEnd_ == nullptr) return wordOfAnyLine();
        while (at_ != plainEnd_ && isBlank(*at_))
            ++at_;
        const char* const begin = at_;
        while (at_ != plainEnd_ && !isBlank(*at_))
            ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    /// Returns the next word of this line or of a later line, or an empty word at the end of the file.
    std::string_view wordOnAnyLine();

    /// Throws Error if `word` has more than kLongestWord characters. Such a word is neither a number nor a keyword.
    void requireShort(std::string_view word) const;

    /// Returns the number `word`, which may be infinite or NaN. Throws Error if the word is not a number, or if the
    /// number is too large for a double.
    double numberOf(std::string_view word) const;

    /// Returns the rest of the current line including comments, without blanks at both ends. Joins continued lines.
    /// Throws Error if the text is longer than 1 MiB.
    std::string rest();

    /// Moves forward to the byte `offset`, which must be the start of a line. `lines` is the number of lines before it.
    void moveTo(std::uint64_t offset, std::uint64_t lines);

    /// Returns the current position in bytes from the start of the file.
    std::uint64_t offset() const { return stream_.offset() + static_cast<std::uint64_t>(at_ - begin_); }

    /// Returns true if the current position is inside a line, before its line end.
    bool isInLine() const { return !isBehindLine_; }

    /// Returns the number of the current line, counted from 1.
    std::uint64_t line() const { return line_; }

    /// Returns "PATH:LINE" of the current line.
    std::string where() const;

private:
    static constexpr bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    /// Returns true if the last character that is not blank is a backslash. Returns `before` if the text is blank.
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
    const char* begin_ = nullptr; // start of the window
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    const char* plainEnd_ = nullptr; // end of a plain line (findPlainEnd); null if the line is not plain
    bool isLast_ = false;            // whether the window contains the end of the file
    bool isBehindLine_ = true;       // whether the current line and its line end are consumed
    std::uint64_t line_ = 0;
    std::string held_; // copy of a word whose bytes are no longer in the window
};

} // namespace gnomon::read
