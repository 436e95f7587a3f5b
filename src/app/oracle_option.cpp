#include "app/oracle_option.h"

namespace gnomon::app {

namespace {

const std::string kFlagAlone(wordOf(proof::kOracles, proof::Oracle::SameDetail));

} // namespace

void OracleOption::addTo(CLI::App& command) {
    command
        .add_option(
            "--oracle",
            text_,
            "Hold the shadows against ray-traced ones, and the picture against the finest level in those; `full` "
            "traces the finest level, which --memory has to hold, and 83 bytes a triangle beside it; `exact` decides "
            "each pixel in integers")
        ->expected(0, 1)
        ->check(
            [](const std::string& text) {
                return valueOf(proof::kOracles, text)
                           ? ""
                           : "it takes nothing, `full` or `exact`, not '" + text + "'; put MODEL before it";
            },
            "")
        ->default_str(kFlagAlone)
        ->type_name("[full|exact]");
}

proof::Oracle OracleOption::mode() const {
    return valueOf(proof::kOracles, text_).value_or(proof::Oracle::None);
}

} // namespace gnomon::app
