// Rejects options that contradict each other, and options that need another option. All commands use the same table of
// rules.
#pragma once

#include "settings/output.h"
#include "settings/settings.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::settings {

/// All option values of a command that draws, as input of the check for contradictions.
struct Request {
    std::string model; // the file of the model
    Settings settings;
    Output output;
};

/// An option, and a function that tells whether the user's request contains it.
struct OptionUse {
    const char* option; // without dashes
    // Returns true if the request uses the option. If null, the option is a setting, which is used if its value is not
    // the default.
    bool (*isUsed)(const Request&) = nullptr;
    // Returns the option as error messages show it. If null, messages show the name of the option, and the value of a
    // setting.
    std::string (*written)(const Request&) = nullptr;
};

/// An option, and the list `others` of options that cannot be combined with it.
struct Contradiction {
    OptionUse option;
    std::vector<OptionUse> others;
    const char* reason;
};

/// An option that has an effect only if the user also gives another option.
struct Requirement {
    OptionUse option;
    bool (*isMet)(const Request&) = nullptr;
    const char* needed = ""; // the needed option, with its value
};

std::span<const Contradiction> contradictions();

std::span<const Requirement> requirements();

/// Throws UsageError for the first options of `request` that contradict each other, or for the first option without
/// another option that it needs. A command that draws no picture passes a request without an output.
void requireSound(const Request& request);

/// Throws UsageError if `settings` contradict each other or lack a needed option. This is for commands that have no
/// options besides settings.
void requireSound(const Settings& settings);

} // namespace gnomon::settings
