// Creates settings from the member of Settings that stores their value.
#pragma once

#include "settings/setting.h"

#include <utility>

namespace gnomon::settings {

/// Creates a setting that is stored in Settings at the reference that `place(settings)` returns.
template <class T, class Place>
Setting at(const Place& place, Description description, const Codec<T>& codec) {
    return {
        std::move(description), codec, place, [place](Settings& settings, const T& value) { place(settings) = value; }};
}

/// Creates a setting whose value is the given member of Settings.
template <class T>
Setting plain(T Settings::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.*member; }, std::move(description), codec);
}

/// Creates a setting whose value is the given member of Quality, the shadow and detail quality of a frame.
template <class T>
Setting quality(T plan::Quality::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.quality.*member; }, std::move(description), codec);
}

/// Creates a setting whose value is the given member of ShadingSettings.
template <class T>
Setting look(T plan::ShadingSettings::*member, Description description, const Codec<T>& codec) {
    return at(
        [member](auto& settings) -> auto& { return settings.quality.look.*member; }, std::move(description), codec);
}

} // namespace gnomon::settings
