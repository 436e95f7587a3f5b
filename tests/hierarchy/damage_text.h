// What a piece of damage is said to be.
#pragma once

#include "hierarchy/bytes.h"

#include <functional>
#include <string>

namespace gnomon::hierarchy {

/// The damage that `act` finds, in its own words; empty if it finds none.
inline std::string damageOf(const std::function<void()>& act) {
    try {
        act();
    } catch (const Damage& damage) {
        return damage.what;
    }
    return {};
}

} // namespace gnomon::hierarchy
