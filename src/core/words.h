// Lists of the words that stand for the values of a type: each stands once, beside the type, as an array of Word.
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// A value and the word for it. A list may have entries with more to them, as long as they have these two.
template <class T>
struct Word {
    T value;
    const char* word;
};

/// The word for `value` in `words`; empty if it has none.
template <class Words, class T>
constexpr std::string_view wordOf(const Words& words, const T& value) {
    for (const auto& each : words)
        if (each.value == value) return each.word;
    return {};
}

/// The value that `word` stands for in `words`; nothing if there is none.
template <class Words>
constexpr auto valueOf(const Words& words, std::string_view word)
    -> std::optional<std::decay_t<decltype(std::begin(words)->value)>> {
    for (const auto& each : words)
        if (each.word == word) return each.value;
    return std::nullopt;
}

/// All words with `between` before each but the first, and `beforeLast` before the last: "off, maps or rays".
template <class Words>
std::string enumerated(const Words& words, std::string_view between, std::string_view beforeLast) {
    std::string text;
    const auto last = std::prev(std::end(words));
    for (auto each = std::begin(words); each != std::end(words); ++each) {
        if (each != std::begin(words)) text += each == last ? beforeLast : between;
        text += each->word;
    }
    return text;
}

} // namespace gnomon
