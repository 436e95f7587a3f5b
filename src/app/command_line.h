// Options that several subcommands have, as CLI11 takes them.
#pragma once

#include "settings/view_options.h"

#include <CLI/CLI.hpp>

namespace gnomon::app {

/// Adds the view and quality options to `command`; `options` must outlive the parsing.
void addViewOptions(CLI::App& command, settings::ViewOptions& options);

/// What a seed may be for CLI11, which takes -1 for the largest of unsigned numbers.
CLI::Validator seedText();

} // namespace gnomon::app
