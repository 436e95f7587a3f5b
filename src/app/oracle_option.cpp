#include "app/oracle_option.h"

namespace gnomon::app {

void addOracleOption(CLI::App& command, validation::GroundTruth& groundTruth) {
    static const std::string kFlagAlone(wordOf(validation::kGroundTruths, validation::GroundTruth::SameDetail));
    command
        .add_option_function<std::string>(
            "--oracle",
            [&groundTruth](const std::string& text) { groundTruth = valueOf(validation::kGroundTruths, text).value(); },
            "Compare with ground truth: rays, full (finest) or exact (integers)")
        ->expected(0, 1)
        ->check(
            [](const std::string& text) {
                return valueOf(validation::kGroundTruths, text)
                           ? ""
                           : "expected no value, full or exact, found '" + text + "'; write MODEL before this option";
            },
            "")
        ->default_str(kFlagAlone)
        ->type_name("[full|exact]");
}

} // namespace gnomon::app
