#include "app/oracle_option.h"

#include "app/option_text.h"

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
        ->default_str(kFlagAlone)
        ->type_name("[full]");
}

render::Oracle OracleOption::mode() const {
    if (text_.empty()) return render::Oracle::None;
    if (text_ == kFlagAlone) return render::Oracle::SameDetail;
    if (text_ != "full") refuse("--oracle", text_, "nothing or `full`");
    return render::Oracle::FullDetail;
}

} // namespace gnomon::app
