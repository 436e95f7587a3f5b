#include "settings/table.h"

namespace gnomon::settings {

std::string forShell(const std::string& text) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.,/:@%";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
    return quoted + "'";
}

std::string optionsToPaste(const Settings& settings, bool ofSwept) {
    std::string options;
    for (const Setting& each : table())
        if (each.description().isSwept == ofSwept && !each.isDefault(settings) && appliesTo(each, settings))
            options += (options.empty() ? "" : " ") + each.option() + " " + forShell(each.text(settings));
    return options;
}

} // namespace gnomon::settings
