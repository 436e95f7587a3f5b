#include "preprocess/read/words.h"

namespace gnomon::read {

std::string quotedForMessage(std::string_view text) {
    constexpr std::size_t kShown = 40;
    std::string result = "\"";
    for (const char c : text.substr(0, kShown))
        result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > kShown ? "...\"" : "\"");
}

} // namespace gnomon::read
