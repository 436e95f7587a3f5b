#include "app/oracle_option.h"

namespace gnomon::app {

void addOracleOption(CLI::App& command, validation::Oracle& oracle) {
    static const std::string kFlagAlone(wordOf(validation::kOracles, validation::Oracle::SameDetail));
    command
        .add_option_function<std::string>(
            "--oracle",
            [&oracle](const std::string& text) { oracle = valueOf(validation::kOracles, text).value(); },
            "Hold the shadows against ray-traced ones, and the picture against the finest level in those; `full` "
            "traces the finest level, which --memory has to hold, and 83 bytes a triangle beside it; `exact` decides "
            "each pixel in integers")
        ->expected(0, 1)
        ->check(
            [](const std::string& text) {
                return valueOf(validation::kOracles, text)
                           ? ""
                           : "it takes nothing, `full` or `exact`, not '" + text + "'; put MODEL before it";
            },
            "")
        ->default_str(kFlagAlone)
        ->type_name("[full|exact]");
}

} // namespace gnomon::app
