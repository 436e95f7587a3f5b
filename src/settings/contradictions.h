// The options that contradict each other, and those that need another one: one table for all commands.
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

/// An option, and the condition on its value.
struct OptionUse {
    const char* option;                               // without dashes
    bool (*isUsed)(const Request&) = nullptr;         // null: it is a setting, and its value is not the default
    std::string (*written)(const Request&) = nullptr; // null: the option, and its value if it is a setting
};

/// An option that contradicts each of the others.
struct Contradiction {
    OptionUse option;
    std::vector<OptionUse> others;
    const char* reason;
};

/// An option that has an effect only beside another one.
struct Requirement {
    OptionUse option;
    bool (*isMet)(const Request&);
    const char* needed; // the other option, with a value
};

std::span<const Contradiction> contradictions();

std::span<const Requirement> requirements();

/// Throws UsageError if options of `request` contradict each other, or if one lacks an option that it needs. The error
/// names the first of them. A request without a picture has no output.
void requireSound(const Request& request);

/// Throws the same for settings without an output.
void requireSound(const Settings& settings);

} // namespace gnomon::settings
