#include "report/self_contained.h"

#include "core/printable.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <utility>

namespace gnomon::report {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t j = 0; j < 3; ++j)
            word = (word << 8U) | (i + j < bytes.size() ? bytes[i + j] : 0U);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j > bytes.size() ? '=' : kDigits[(word >> (18U - 6U * j)) & 63U];
    }
    return text;
}

namespace {

/// Makes each line of each string in `data` printable.
void makePrintable(nlohmann::json& data) {
    if (data.is_structured())
        for (nlohmann::json& value : data)
            makePrintable(value);
    if (!data.is_string()) return;
    const std::string_view text = data.get_ref<const std::string&>();
    std::string shown;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        shown += printable(text.substr(begin, end - begin));
        if (end < text.size()) shown += '\n';
        begin = end + 1;
    }
    data = std::move(shown);
}

} // namespace

std::string scriptSafe(nlohmann::json data) {
    makePrintable(data);
    const std::string text = telemetry::jsonText(data);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    }
    return safe;
}

void substitute(std::string& text, std::string_view mark, std::string_view value) {
    const auto place = text.find(mark);
    if (place != std::string::npos) text.replace(place, mark.size(), value);
}

} // namespace gnomon::report
