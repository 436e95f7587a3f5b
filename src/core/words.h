// Tables that map enumerators and other values to names. Each table is an array of Word and is defined next to its
// type.
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// A row of a table of names: a value and its name. Some tables use row types with more members.
template <class T>
struct Word {
    T value;
    const char* word;
};

/// Returns the name of `value` in the table `words`, or an empty string if the table does not contain the value.
template <class Words, class T>
constexpr std::string_view wordOf(const Words& words, const T& value) {
    for (const auto& each : words)
        if (each.value == value) return each.word;
    return {};
}

/// Returns the value with the name `word` in the table `words`, or nullopt.
template <class Words>
constexpr auto valueOf(const Words& words, std::string_view word)
    -> std::optional<std::decay_t<decltype(std::begin(words)->value)>> {
    for (const auto& each : words)
        if (each.word == word) return each.value;
    return std::nullopt;
}

/// Joins all names of the table `words` to one text, such as "off, maps or rays". `beforeLast` precedes the last name,
/// and `between` separates the others.
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
