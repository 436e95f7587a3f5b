// The message of a Damage exception.
#pragma once

#include "hierarchy/bytes.h"

#include <functional>
#include <string>

namespace gnomon::hierarchy {

/// Returns the message of the Damage that `act` throws, or an empty text if it throws none.
inline std::string damageOf(const std::function<void()>& act) {
    try {
        act();
    } catch (const Damage& damage) {
        return damage.what;
    }
    return {};
}

} // namespace gnomon::hierarchy
