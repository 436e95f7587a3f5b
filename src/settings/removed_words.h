// Options and option words that no longer exist, each with the sentence that names the replacement.
#pragma once

#include <string_view>

namespace gnomon::settings {

/// Throws UsageError if `option` no longer takes `word`. The message names the replacement.
void refuseRemovedWord(std::string_view option, std::string_view word);

/// Throws UsageError if `option` no longer exists. `option` is "--name" or "--name=text".
void refuseRemovedOption(std::string_view option);

} // namespace gnomon::settings
