// Converts JSON documents with arbitrary bytes in strings to text, because a file name need not be UTF-8.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {

/// Returns `document` as JSON text, on one line if `indent` is negative. Invalid UTF-8 becomes U+FFFD. All characters
/// outside ASCII are written as "\u1234", so that no control character reaches the terminal.
template <class Json>
std::string jsonText(const Json& document, int indent = -1) {
    return document.dump(indent, ' ', true, Json::error_handler_t::replace);
}

} // namespace gnomon::telemetry
