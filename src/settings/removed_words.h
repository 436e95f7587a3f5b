// Options and option values that no longer exist, each with a sentence that names the replacement.
#pragma once

#include <string_view>

namespace gnomon::settings {

/// Throws UsageError if `word` was a value of `option` in an earlier version. The message names the replacement.
void refuseRemovedWord(std::string_view option, std::string_view word);

/// Throws UsageError if `option` existed in an earlier version only. `option` is "--name" or "--name=text".
void refuseRemovedOption(std::string_view option);

} // namespace gnomon::settings
