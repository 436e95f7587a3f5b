#include "settings/removed_words.h"

#include "settings/usage_error.h"

#include <array>
#include <string>

namespace gnomon::settings {

namespace {

struct Removed {
    std::string_view option;
    std::string_view word; // empty: the option itself is removed
    std::string_view replacement;
};

constexpr std::array kRemoved = {
    Removed{"--local-tmp", "", "all temporary files of a build are in --tmp"},
    Removed{"--warp", "fitted", "use --warp log, which keeps its aliasing bound in the whole frustum"},
};

void refuse(const Removed& removed) {
    const std::string given =
        std::string(removed.option) + (removed.word.empty() ? "" : " ") + std::string(removed.word);
    throw UsageError{std::string(removed.option), given + " is removed: " + std::string(removed.replacement)};
}

} // namespace

void refuseRemovedWord(std::string_view option, std::string_view word) {
    for (const Removed& removed : kRemoved)
        if (!removed.word.empty() && removed.option == option && removed.word == word) refuse(removed);
}

void refuseRemovedOption(std::string_view option) {
    const std::string_view name = option.substr(0, option.find('='));
    for (const Removed& removed : kRemoved)
        if (removed.word.empty() && removed.option == name) refuse(removed);
}

} // namespace gnomon::settings
