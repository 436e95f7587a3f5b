// Functions that make a setting from the member of Settings that contains its value.
#pragma once

#include "settings/setting.h"

#include <utility>

namespace gnomon::settings {

/// Returns a setting whose value is `place(settings)`, a reference into Settings.
template <class T, class Place>
Setting at(const Place& place, Description description, const Codec<T>& codec) {
    return {
        std::move(description), codec, place, [place](Settings& settings, const T& value) { place(settings) = value; }};
}

/// Returns a setting whose value is a member of Settings.
template <class T>
Setting plain(T Settings::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.*member; }, std::move(description), codec);
}

/// Returns a setting whose value is a member of Quality.
template <class T>
Setting quality(T plan::Quality::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.quality.*member; }, std::move(description), codec);
}

/// Returns a setting whose value is a member of ShadingSettings.
template <class T>
Setting look(T plan::ShadingSettings::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.quality.look.*member; }, std::move(description), codec);
}

} // namespace gnomon::settings
