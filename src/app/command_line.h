// Options that several subcommands have, as CLI11 takes them.
#pragma once

#include "settings/axes.h"
#include "settings/resolve.h"
#include "settings/settings.h"
#include "settings/value_colors.h"

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace gnomon::app {

/// The settings of one command line: the options that the table of settings makes, and what was written behind them.
class SettingOptions {
public:
    /// Adds an option for each setting to `command`; this must outlive the parsing.
    void addTo(CLI::App& command);

    /// One value each. Throws UsageError.
    settings::Settings settings() const;

    /// Likewise, for a bench: those that it sweeps are as they are by default.
    settings::Settings fixedSettings() const;

    /// Those that are swept, each with the values of its list; a list of `shadowMaps`, if given, is the number of
    /// slices with faces off. Throws UsageError.
    std::vector<settings::Axis> axes(const std::optional<std::string>& shadowMaps) const;

    /// Throws UsageError if `option`, which is about shadow maps, was given beside `--shadows exact`.
    void requireMapsFor(const std::string& option) const;

private:
    settings::SettingTexts texts_; // of the settings that were given
};

/// Adds --color-by, --colormap and --color-range to `command`; `words` must outlive the parsing.
void addColorOptions(CLI::App& command, settings::ValueColorWords& words);

/// Throws UsageError where `settings` ask for the window, in which only `gnomon view` draws.
void requireNoWindow(const settings::Settings& settings);

/// What a seed may be for CLI11, which takes -1 for the largest of unsigned numbers.
CLI::Validator seedText();

} // namespace gnomon::app
