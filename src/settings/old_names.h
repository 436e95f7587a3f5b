// The old names of renamed options. The command line still accepts them, but help, manual pages and completions do not
// list them.
#pragma once

#include <string>
#include <string_view>

namespace gnomon::settings {

/// Returns the current name of an option, given and returned without dashes. For the old name "near" it returns
/// "shadow-near". Returns `name` itself if it is not an old name.
std::string_view currentName(std::string_view name);

/// Returns `option` followed by its old names, in the format that CLI11 parses as aliases: "--geodetic,--ecef".
std::string withOldNames(const std::string& option);

} // namespace gnomon::settings
