// Options that contradict each other, and options that need another option. One table is valid for all commands.
#pragma once

#include "settings/output.h"
#include "settings/settings.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::settings {

/// The values of all options of a command that draws.
struct Request {
    std::string model; // the file of the model
    Settings settings;
    Output output;
};

/// An option, and the condition under which a request uses it.
struct OptionUse {
    const char* option; // without dashes
    // If null, the option is a setting. A request uses it if its value is not the default.
    bool (*isUsed)(const Request&) = nullptr;
    // Returns the option as error messages show it. If null, they show its name, with the value if it is a setting.
    std::string (*written)(const Request&) = nullptr;
};

/// An option that cannot be combined with any of `others`.
struct Contradiction {
    OptionUse option;
    std::vector<OptionUse> others;
    const char* reason;
};

/// An option that has an effect only together with another option.
struct Requirement {
    OptionUse option;
    bool (*isMet)(const Request&);
    const char* needed; // the needed option, with its value
};

std::span<const Contradiction> contradictions();

std::span<const Requirement> requirements();

/// Throws UsageError if options of `request` contradict each other, or if an option lacks another option that it needs.
/// The error names the first such option. A command without a picture passes a request without an output.
void requireSound(const Request& request);

/// Throws the same errors for a command whose only options are `settings`.
void requireSound(const Settings& settings);

} // namespace gnomon::settings
