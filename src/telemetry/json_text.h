// JSON as text, whatever bytes its strings hold: the name of a file need not be UTF-8.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {

/// `document` as text, on one line if `indent` is below 0; what is not UTF-8 in it becomes U+FFFD.
template <class Json>
std::string jsonText(const Json& document, int indent = -1) {
    return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace gnomon::telemetry
