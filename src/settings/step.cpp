#include "settings/step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace gnomon::settings {

namespace {

/// Returns the entry that is `steps` positions after `current` in the list `all`, with wrap-around. Returns the first
/// entry if `current` is not in the list.
template <class T>
T around(const std::vector<T>& all, const T& current, int steps) {
    const auto found = std::find(all.begin(), all.end(), current);
    if (found == all.end()) return all.front();
    const auto count = static_cast<int>(all.size());
    const auto at = static_cast<int>(found - all.begin());
    return all[static_cast<std::size_t>(((at + steps) % count + count) % count)];
}

int clamped(const Offer& offer, int value) {
    return std::clamp(value, static_cast<int>(offer.min), static_cast<int>(offer.max));
}

int stepped(const Offer& offer, int value, int steps) {
    return offer.steps.empty() ? clamped(offer, value + steps) : around(offer.steps, value, steps);
}

std::optional<int> stepped(const Setting& setting, std::optional<int> value, int steps) {
    const int usual = std::any_cast<std::optional<int>>(setting.value(Settings())).value_or(1);
    if (steps != 0) return stepped(setting.description().offer, value.value_or(usual), steps);
    return value ? std::nullopt : std::optional(usual);
}

/// Doubles the shorter side of `size`, or halves the longer side. Powers of two remain powers of two.
std::array<int, 2> stepped(const Offer& offer, std::array<int, 2> size, int steps) {
    const auto [shorter, longer] = std::minmax_element(size.begin(), size.end());
    int& side = steps > 0 ? *shorter : *longer;
    side = clamped(offer, steps > 0 ? side * 2 : side / 2);
    return size;
}

} // namespace

void step(const Setting& setting, Settings& settings, int steps) {
    const Offer& offer = setting.description().offer;
    const Value value = setting.value(settings);
    switch (setting.kind()) {
    case Kind::Words:
        return setting.set(settings, setting.parse(around(setting.words(), setting.text(value), steps)));
    case Kind::Switch:
        return setting.set(settings, !std::any_cast<bool>(value));
    case Kind::Whole:
        return setting.set(settings, stepped(offer, std::any_cast<int>(value), steps));
    case Kind::WholeOrAuto:
        return setting.set(settings, stepped(setting, std::any_cast<std::optional<int>>(value), steps));
    case Kind::Number: {
        const double factor = std::exp2(0.5 * steps);
        return setting.set(settings, std::clamp(std::any_cast<double>(value) * factor, offer.min, offer.max));
    }
    case Kind::Size:
        return setting.set(settings, stepped(offer, std::any_cast<std::array<int, 2>>(value), steps));
    case Kind::Other:
        return;
    }
}

std::string inWords(const Setting& setting, const Settings& settings) {
    std::string text = setting.text(settings);
    if (setting.kind() == Kind::Number) {
        std::array<char, 32> shorter{};
        std::snprintf(shorter.data(), shorter.size(), "%.3g", std::any_cast<double>(setting.value(settings)));
        text = shorter.data();
    }
    return setting.description().offer.title + ": " + text;
}

} // namespace gnomon::settings
