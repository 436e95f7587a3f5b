// Making a setting of the place in Settings where its value stands.
#pragma once

#include "settings/setting.h"

#include <utility>

namespace gnomon::settings {

/// A setting whose value stands where `place` points to.
template <class T, class Place>
Setting at(const Place& place, Description description, const Codec<T>& codec) {
    return {
        std::move(description), codec, place, [place](Settings& settings, const T& value) { place(settings) = value; }};
}

/// A setting whose value is a member of Settings.
template <class T>
Setting plain(T Settings::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.*member; }, std::move(description), codec);
}

/// A setting whose value is a member of Quality.
template <class T>
Setting quality(T plan::Quality::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.quality.*member; }, std::move(description), codec);
}

/// A setting whose value is a member of Look.
template <class T>
Setting look(T plan::Look::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.quality.look.*member; }, std::move(description), codec);
}

} // namespace gnomon::settings
