// JSON as text, whatever bytes its strings hold: the name of a file need not be UTF-8.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {

/// Returns `document` as text, on one line if `indent` is below 0. Bytes that are not UTF-8 become U+FFFD. All
/// characters beyond ASCII are written as "\u1234", so that none of them acts on a terminal.
template <class Json>
std::string jsonText(const Json& document, int indent = -1) {
    return document.dump(indent, ' ', true, Json::error_handler_t::replace);
}

} // namespace gnomon::telemetry
