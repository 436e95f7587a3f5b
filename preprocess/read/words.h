// Lines of text as words.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::read {

/// The words of `line` between blanks; they point into it.
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

/// `text` with its ASCII letters in lower case.
inline std::string lowered(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return result;
}

/// The last suffix of the file name in `path`, with its dot, in lower case; empty if it has none.
inline std::string loweredSuffix(std::string_view path) {
    const std::size_t dot = path.find_last_of("./");
    return lowered(dot == std::string_view::npos || path[dot] == '/' ? "" : path.substr(dot));
}

/// The beginning of `text` in quotes with unprintable bytes as "?": a file can hold anything, an error is one line.
inline std::string quotedForMessage(std::string_view text) {
    constexpr std::size_t kShown = 40;
    std::string result = "\"";
    for (const char c : text.substr(0, kShown))
        result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > kShown ? "...\"" : "\"");
}

} // namespace gnomon::read
