#include "app/oracle_option.h"

namespace gnomon::app {

namespace {

constexpr const char* kFlagAlone = "same";

} // namespace

void OracleOption::addTo(CLI::App& command) {
    command
        .add_option(
            "--oracle",
            text_,
            "Hold the shadows against ray-traced ones, and the picture against the finest level in those; `full` "
            "traces the finest level")
        ->expected(0, 1)
        ->check(
            [](const std::string& text) {
                const bool isWord = text == kFlagAlone || text == "full";
                return isWord ? "" : "it takes nothing or `full`, not '" + text + "'; put MODEL before it";
            },
            "")
        ->default_str(kFlagAlone)
        ->type_name("[full]");
}

frame::Oracle OracleOption::mode() const {
    if (text_.empty()) return frame::Oracle::None;
    return text_ == kFlagAlone ? frame::Oracle::SameDetail : frame::Oracle::FullDetail;
}

} // namespace gnomon::app
