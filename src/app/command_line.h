// CLI11 options that several subcommands share.
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

/// Adds all settings (settings/table.h) as options to a command, and stores their texts.
class SettingOptions {
public:
    /// Adds one option per setting to `command`. This object must exist until the command line is parsed.
    void addTo(CLI::App& command);

    /// Returns the settings that the user gave on the command line. They are free of contradictions, and the camera
    /// file is read. Throws UsageError and Error.
    settings::Settings settings() const;

    /// Returns the settings that the user gave on the command line, without a check for contradictions. Throws
    /// UsageError for an invalid value.
    settings::Settings parsed() const;

    /// Returns the settings that all runs of `gnomon bench` share. The settings that the bench sweeps have their
    /// defaults. Throws UsageError and Error as `settings` does.
    settings::Settings fixedSettings() const;

    /// Returns one axis for each setting that `gnomon bench` sweeps, with the values from the command line.
    /// `shadowMaps` is an optional list of numbers of maps, which becomes the axis of --z-partitions, without face
    /// partitions. Throws UsageError.
    std::vector<settings::Axis> axes(const std::optional<std::string>& shadowMaps) const;

    /// Throws UsageError if the user requests exact shadows, because `option` has an effect on shadow maps only.
    void requireMapsFor(const std::string& option) const;

private:
    settings::SettingTexts texts_; // texts of the given options
};

/// Adds the options --color-by, --colormap and --color-range to `command`. `words` must exist until the command line is
/// parsed.
void addColorOptions(CLI::App& command, settings::ValueColorWords& words);

/// Throws UsageError if the user requests the backend `window`, which only `gnomon view` can use.
void requireNoWindow(const settings::Settings& settings);

/// Returns a validator for the seed of a random generator. CLI11 itself would accept -1 as the max unsigned number.
CLI::Validator seedText();

} // namespace gnomon::app
