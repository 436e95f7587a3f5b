// Splits lines of text into words and converts words.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::read {

/// Returns the words of `line`, which blanks separate. The results point into the memory of `line`.
inline std::vector<std::string_view> wordsOf(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    std::vector<std::string_view> result;
    std::size_t begin = line.find_first_not_of(kBlanks);
    while (begin != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
        result.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(kBlanks, end);
    }
    return result;
}

/// Returns `text` with its ASCII letters in lower case.
inline std::string lowered(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return result;
}

/// Returns true if `text` is short and plain enough for a name in a report: at most 16 characters, and only ASCII
/// letters, digits, '_', '-' and blanks.
inline bool isPlainName(std::string_view text) {
    constexpr std::size_t kLongest = 16;
    return text.size() <= kLongest && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                      c == '-' || c == ' ';
           });
}

/// Returns `text` without its quotes if it begins and ends with a quote. Otherwise returns `text`.
inline std::string_view unquoted(std::string_view text) {
    const bool hasQuotes = text.size() > 2 && text.front() == '"' && text.back() == '"';
    return hasQuotes ? text.substr(1, text.size() - 2) : text;
}

/// Returns the last suffix of the file name in `path`, with its dot and in lower case, for example ".ply". Returns an
/// empty string if there is no suffix.
inline std::string loweredSuffix(std::string_view path) {
    const std::size_t dot = path.find_last_of("./");
    return lowered(dot == std::string_view::npos || path[dot] == '/' ? "" : path.substr(dot));
}

/// Returns the first 40 characters of `text` in quotes for an error message. Unprintable bytes become "?", so that the
/// message remains one line for any file.
inline std::string quotedForMessage(std::string_view text) {
    constexpr std::size_t kShown = 40;
    std::string result = "\"";
    for (const char c : text.substr(0, kShown))
        result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > kShown ? "...\"" : "\"");
}

} // namespace gnomon::read
