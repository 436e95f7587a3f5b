// Rejects options and option values that no longer exist. Each error message names the replacement.
#pragma once

#include <string_view>

namespace gnomon::settings {

/// Throws UsageError if `word` is a removed value of `option`. The message names the replacement.
void refuseRemovedWord(std::string_view option, std::string_view word);

/// Throws UsageError if `option` is a removed option. `option` has the form "--name" or "--name=text".
void refuseRemovedOption(std::string_view option);

} // namespace gnomon::settings
