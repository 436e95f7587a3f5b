// The earlier names of renamed options. Old names still work, but help, manual pages and completions do not list them.
#pragma once

#include <string>
#include <string_view>

namespace gnomon::settings {

/// Returns the current name of the option `name`, without dashes: "shadow-near" for "near". Returns `name` if the
/// option was not renamed.
std::string_view currentName(std::string_view name);

/// Returns `option` with its old names, in the format of CLI11: "--geodetic,--ecef". A value of any of them is a value
/// of `option`.
std::string withOldNames(const std::string& option);

} // namespace gnomon::settings
