// How values are written: for each type of value what reads it from text, what writes it, and what a text must be.
#pragma once

#include "core/units.h"
#include "core/words.h"
#include "settings/usage_error.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::settings {

/// How values of one type are written. Writing a value that was read gives a text that reads back as the same value.
template <class T>
struct Codec {
    std::function<std::optional<T>(const std::string& text)> read; // nothing: the text is none
    std::function<std::string(const T& value)> write;
    std::string expected;             // of a text, for whom is refused
    std::vector<std::string> words{}; // all texts, where they are words of a list
};

/// The value of `text`. Throws UsageError that names `option`.
template <class T>
T parsed(const Codec<T>& codec, const std::string& option, const std::string& text) {
    std::optional<T> value = codec.read(text);
    if (!value) refuse(option, text, codec.expected);
    return *value;
}

/// The shortest text that reads back as `value`: "0.1".
std::string shortest(double value);

/// Finite numbers that `isAllowed`; `expected` names them.
Codec<double> number(std::string expected, bool (*isAllowed)(double));
Codec<double> anyNumber();
Codec<double> positiveNumber();

/// A distance whose ratios and products a float can still hold.
Codec<double> distance();

/// Whole numbers in [low, high].
Codec<int> whole(int low, int high);

/// A whole number from 0 to 2^64 - 1.
Codec<std::uint64_t> seed();

/// "on" and "off".
Codec<bool> onOff();

/// "x,y,z".
Codec<glm::dvec3> vector();

/// "x,y,z" of a length that is finite and above 0.
Codec<glm::dvec3> direction();

/// Stands for "auto" where a direction is asked for.
constexpr glm::dvec3 kAutoUp{0};

/// A direction, the name of an axis ("z", "-x"), or "auto".
Codec<glm::dvec3> upDirection();

/// "WxH", both at least 1, that `isAllowed`; `limit` says what of them is, behind a comma.
Codec<std::array<int, 2>> size(const std::string& limit, bool (*isAllowed)(const std::array<int, 2>& size));

/// A count above 0 such as 500k or 2M.
Codec<std::uint64_t> count();

/// A memory size above 0 such as 512M or 2G.
Codec<Bytes> memory();

/// Any text.
Codec<std::string> text();

/// The parts of `list` between commas: at least one, none of them empty. Throws UsageError that names `option`.
std::vector<std::string> listItems(const std::string& option, const std::string& list);

/// "auto", which is nothing, and what `codec` reads.
template <class T>
Codec<std::optional<T>> orAuto(Codec<T> codec) {
    const std::string expected = "auto or " + codec.expected;
    return {
        [read = codec.read](const std::string& text) -> std::optional<std::optional<T>> {
            if (text == "auto") return std::optional<T>();
            if (const std::optional<T> value = read(text)) return value;
            return std::nullopt;
        },
        [write = codec.write](const std::optional<T>& value) { return value ? write(*value) : std::string("auto"); },
        expected};
}

/// What `codec` reads; nothing, which has no text, is what was not given.
template <class T>
Codec<std::optional<T>> ifGiven(Codec<T> codec) {
    return {
        [read = codec.read](const std::string& text) -> std::optional<std::optional<T>> {
            if (const std::optional<T> value = read(text)) return value;
            return std::nullopt;
        },
        [write = codec.write](const std::optional<T>& value) { return value ? write(*value) : std::string(); },
        codec.expected};
}

/// The words of a list (core/words.h). A value that has none is written as nothing.
template <class Words>
auto oneOf(const Words& words) {
    using T = std::decay_t<decltype(std::begin(words)->value)>;
    Codec<T> codec{
        [&words](const std::string& text) -> std::optional<T> { return valueOf(words, text); },
        [&words](const T& value) { return std::string(wordOf(words, value)); },
        enumerated(words, ", ", " or ")};
    for (const auto& each : words)
        codec.words.emplace_back(each.word);
    return codec;
}

} // namespace gnomon::settings
