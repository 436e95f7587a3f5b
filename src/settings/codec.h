// Converts option values between text and typed values. A codec has a function that parses a type, a function that
// writes it, and a description of the valid texts for error messages.
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

/// Converts values of one type from and to text. `read` parses each text that `write` returns to the same value.
template <class T>
struct Codec {
    std::function<std::optional<T>(const std::string& text)> read; // nullopt: the text is invalid
    std::function<std::string(const T& value)> write;
    std::string expected;             // the valid texts, for error messages
    std::vector<std::string> words{}; // all valid texts, if the type is a list of words
};

/// Returns the value that `codec` parses from `text`. Throws UsageError that names `option` if the text is invalid.
template <class T>
T parsed(const Codec<T>& codec, const std::string& option, const std::string& text) {
    std::optional<T> value = codec.read(text);
    if (!value) refuse(option, text, codec.expected);
    return *value;
}

/// Returns the shortest decimal text that parses to exactly `value`, such as "0.1".
std::string shortest(double value);

/// Returns the text codec for finite numbers that `isAllowed` accepts. `expected` describes these numbers in error
/// messages.
Codec<double> number(std::string expected, bool (*isAllowed)(double));

/// Returns the text codec for finite numbers.
Codec<double> anyNumber();

/// Returns the text codec for finite numbers above 0.
Codec<double> positiveNumber();

/// Returns the text codec for distances from 1e-15 to 1e15. With these limits, ratios and products of two distances do
/// not overflow a float.
Codec<double> distance();

/// Returns the text codec for whole numbers in [low, high].
Codec<int> whole(int low, int high);

/// Returns the text codec for the seed of a random generator, a whole number from 0 to 2^64 - 1.
Codec<std::uint64_t> seed();

/// Returns the text codec for "on" and "off".
Codec<bool> onOff();

/// Returns the text codec for "x,y,z", three finite numbers.
Codec<glm::dvec3> vector();

/// Returns the text codec for "x,y,z", a vector whose length is finite and above 0.
Codec<glm::dvec3> direction();

/// The value that the codec of `upDirection` returns for the word "auto".
constexpr glm::dvec3 kAutoUp{0};

/// Returns the text codec for an up direction: "x,y,z", the name of an axis ("z", "-x"), or "auto".
Codec<glm::dvec3> upDirection();

/// Returns the text codec for a size "WxH" in which W and H are at least 1. It rejects sizes for which `isAllowed`
/// returns false. Error messages describe this condition as "WxH, LIMIT", where LIMIT is the text `limit`.
Codec<std::array<int, 2>> size(const std::string& limit, bool (*isAllowed)(const std::array<int, 2>& size));

/// Returns the text codec for a count above 0, such as 500k or 2M (powers of 1000).
Codec<std::uint64_t> count();

/// Returns the text codec for a memory size above 0, such as 512M or 2G (powers of 1024).
Codec<Bytes> memory();

/// Returns the codec that accepts any text.
Codec<std::string> text();

/// Splits the comma-separated `list` and returns its items, at least one. Throws UsageError that names `option` if an
/// item is empty.
std::vector<std::string> listItems(const std::string& option, const std::string& list);

/// Returns a text codec that accepts the word "auto" besides the texts of `codec`. Its value for "auto" is nullopt.
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

/// Returns a text codec for an option without a default. If the user does not give the option, its value is nullopt and
/// its text is empty.
template <class T>
Codec<std::optional<T>> ifGiven(Codec<T> codec) {
    return {
        [read = codec.read](const std::string& text) -> std::optional<std::optional<T>> {
            if (const std::optional<T> value = read(text)) return value;
            return std::nullopt;
        },
        [write = codec.write](const std::optional<T>& value) { return value ? write(*value) : std::string(); },
        codec.expected,
        codec.words};
}

/// Returns the text codec for the words of the table `words`, which has one word per value (core/words.h). A value
/// without a word is written as an empty text.
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
