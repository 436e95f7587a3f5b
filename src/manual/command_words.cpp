#include "manual/command_words.h"

#include "core/error.h"
#include "settings/old_names.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace gnomon::manual {

namespace {

/// Returns the allowed values from the type text of an option, for example "a" and "b" from "KIND:{a,b}". In
/// "auto|on|MB" the words in capitals are placeholders and are skipped.
std::vector<std::string> choicesOf(const std::string& type) {
    const std::size_t open = type.find('{');
    const std::size_t close = type.find('}');
    const bool isListed = open != std::string::npos && close != std::string::npos && open < close;
    if (!isListed && type.find('|') == std::string::npos) return {};
    std::istringstream in(isListed ? type.substr(open + 1, close - open - 1) : type);
    std::vector<std::string> choices;
    for (std::string part; std::getline(in, part, isListed ? ',' : '|');)
        if (part.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos)
            choices.push_back(part);
    return choices;
}

/// Returns the long names of `option` without its old names.
std::vector<std::string> currentNames(const CLI::Option& option) {
    const std::vector<std::string>& all = option.get_lnames();
    std::vector<std::string> names;
    std::copy_if(all.begin(), all.end(), std::back_inserter(names), [&](const std::string& name) {
        const std::string now(settings::currentName(name));
        return now == name || std::find(all.begin(), all.end(), now) == all.end();
    });
    return names;
}

OptionWords optionWords(const CLI::Option& option, const std::string& command) {
    OptionWords words;
    for (const std::string& name : option.get_snames())
        words.names.push_back("-" + name);
    for (const std::string& name : currentNames(option))
        words.names.push_back("--" + name);
    if (option.nonpositional()) words.place = settings::helpPlace(command, words.names.back().substr(2));
    if (words.names.empty()) words.names.push_back(option.get_name(true));
    // CLI11 appends the validator of a value to its type: "TEXT:{auto,bar}", "INT:INT in [0 - 1024]".
    const std::string type = option.get_type_name();
    const bool takesValue = option.get_items_expected_max() > 0;
    if (takesValue) words.choices = choicesOf(type);
    if (takesValue) words.value = type.substr(0, type.find(':'));
    if (takesValue && words.value.empty()) words.value = "VALUE";
    // If an option can occur without a value, the default text of CLI11 is the value for this case.
    const bool isFlagToo = option.get_items_expected_min() == 0;
    if (!isFlagToo) words.byDefault = option.get_default_str();
    words.description = option.get_description();
    words.isRequired = option.get_required() || option.get_option_text() == kRequiredWithoutSubcommand;
    words.isRepeated = option.get_items_expected_max() > 1;
    return words;
}

CommandWords wordsOf(const CLI::App& command, std::vector<std::string> path) {
    CommandWords words;
    words.description = command.get_description();
    words.notes = command.get_footer();
    while (words.notes.ends_with('\n'))
        words.notes.pop_back();
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;
        (option->nonpositional() ? words.options : words.arguments).push_back(optionWords(*option, command.get_name()));
    }
    std::sort(words.options.begin(), words.options.end(), [](const OptionWords& a, const OptionWords& b) {
        return a.place.rank < b.place.rank;
    });
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; })) {
        if (below->get_group().empty()) continue;
        std::vector<std::string> longer = path;
        longer.push_back(below->get_name());
        words.commands.push_back(wordsOf(*below, std::move(longer)));
    }
    words.path = std::move(path);
    return words;
}

} // namespace

CommandWords commandWords(const CLI::App& program) {
    return wordsOf(program, {});
}

const CommandWords& commandAt(const CommandWords& program, const std::vector<std::string>& path) {
    const CommandWords* at = &program;
    for (const std::string& name : path) {
        const auto found = std::find_if(at->commands.begin(), at->commands.end(), [&](const CommandWords& command) {
            return command.path.back() == name;
        });
        if (found == at->commands.end()) throw Error("there is no command '" + name + "'");
        at = &*found;
    }
    return *at;
}

std::string joinedPath(const CommandWords& command, const std::string& first, const std::string& between) {
    std::string joined = first;
    for (const std::string& word : command.path)
        joined += between + word;
    return joined;
}

} // namespace gnomon::manual
