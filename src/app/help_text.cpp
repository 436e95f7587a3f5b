#include "app/help_text.h"

#include <algorithm>

namespace gnomon::app {

namespace {

using manual::CommandWords;
using manual::OptionWords;

constexpr std::size_t kMaxLabel = 26; // max columns of an option with its value; a longer label has its own line
constexpr std::size_t kMaxForm = 14;  // max columns of a list of words that replaces the value: "on|off"

std::string padded(const std::string& text, std::size_t columns) {
    return text + std::string(columns - std::min(columns, text.size()), ' ');
}

/// Returns the value of an option as the help shows it: "WxH", "on|off", or only the first part of a long form.
std::string valueOf(const OptionWords& option) {
    std::string words;
    for (const std::string& choice : option.choices)
        words += (words.empty() ? "" : "|") + choice;
    const bool isListed = option.value.find('|') == std::string::npos;
    if (isListed && !words.empty() && words.size() <= kMaxForm) return words;
    return option.value.size() <= kMaxForm ? option.value : option.value.substr(0, option.value.find('|'));
}

/// Returns the names and the value of an option as the help shows them: "-o, --output FILE.png".
std::string labelOf(const OptionWords& option) {
    std::string label;
    for (const std::string& name : option.names)
        label += (label.empty() ? "" : ", ") + name;
    if (option.names.front().front() != '-') return label;
    const std::string value = valueOf(option);
    return value.empty() ? label : label + " " + value;
}

std::string explanationOf(const OptionWords& option) {
    return option.byDefault.empty() ? option.description : option.description + " [default: " + option.byDefault + "]";
}

/// Appends `text` to the help, in lines of at most kHelpColumns columns. All lines of the text begin in column
/// `indent`. The first one continues the last line of `out`.
void addWrapped(std::string& out, const std::string& text, std::size_t indent) {
    std::size_t column = indent;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find(' ', start), text.size());
        const std::size_t length = end - start;
        if (column > indent && column + 1 + length > kHelpColumns) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (column > indent) {
            out += ' ';
            ++column;
        }
        out.append(text, start, length);
        column += length;
        start = end + 1;
    }
    out += '\n';
}

void addOption(std::string& out, const OptionWords& option, const std::string& before, std::size_t labelColumns) {
    const std::string label = labelOf(option);
    const std::size_t indent = before.size() + labelColumns + 2;
    out += before + label;
    const bool fits = label.size() <= labelColumns;
    out += fits ? std::string(labelColumns + 2 - label.size(), ' ') : "\n" + std::string(indent, ' ');
    addWrapped(out, explanationOf(option), indent);
}

std::string usageOf(const CommandWords& command, const std::string& name) {
    std::string usage = "Usage: " + name;
    for (const OptionWords& argument : command.arguments) {
        const std::string word = argument.names.front() + (argument.isRepeated ? "..." : "");
        usage += argument.isRequired ? " " + word : " [" + word + "]";
    }
    for (const OptionWords& option : command.options)
        if (option.isRequired) usage += " " + option.names.front() + " " + valueOf(option);
    const bool needsCommand = !command.commands.empty() && command.arguments.empty();
    return usage + (!needsCommand ? " [OPTIONS]\n" : " COMMAND [OPTIONS]\n");
}

std::size_t labelColumnsOf(const std::vector<const OptionWords*>& options) {
    std::size_t columns = 0;
    for (const OptionWords* option : options)
        if (const std::size_t size = labelOf(*option).size(); size <= kMaxLabel) columns = std::max(columns, size);
    return columns;
}

/// Returns the arguments and options of `command` that a help text with this `detail` shows, in the order of the help.
std::vector<const OptionWords*> shownOptions(const CommandWords& command, HelpDetail detail) {
    std::vector<const OptionWords*> shown;
    for (const auto* const list : {&command.arguments, &command.options})
        for (const OptionWords& option : *list)
            if (detail == HelpDetail::All || option.place.tier == settings::Tier::Everyday) shown.push_back(&option);
    return shown;
}

void addCommands(std::string& out, const CommandWords& command) {
    if (command.commands.empty()) return;
    out += "\nCommands:\n";
    std::size_t columns = 0;
    for (const CommandWords& below : command.commands)
        columns = std::max(columns, below.path.back().size());
    for (const CommandWords& below : command.commands) {
        out += "  " + padded(below.path.back(), columns + 2);
        addWrapped(out, below.description, columns + 4);
    }
}

void addOptions(std::string& out, const std::vector<const OptionWords*>& shown, HelpDetail detail) {
    const std::size_t columns = labelColumnsOf(shown);
    for (const settings::GroupNames& group : settings::kGroups) {
        bool isFirst = true;
        for (const OptionWords* option : shown) {
            if (option->place.group != group.group) continue;
            const bool isShort = detail == HelpDetail::Everyday;
            if (isFirst && !isShort) out += "\n" + std::string(group.title) + ":\n";
            addOption(out, *option, isShort ? padded(isFirst ? group.label : "", 9) : "  ", columns);
            isFirst = false;
        }
    }
}

} // namespace

std::string helpText(const CommandWords& command, const std::string& name, HelpDetail detail) {
    std::string out;
    addWrapped(out, command.description, 0);
    out += usageOf(command, name);
    const std::vector<const OptionWords*> shown = shownOptions(command, detail);
    if (detail == HelpDetail::Everyday && !shown.empty()) out += '\n';
    addOptions(out, shown, detail);
    addCommands(out, command);
    if (detail == HelpDetail::Everyday)
        out += "\n" + name + (command.commands.empty() ? "" : " COMMAND") + " --help-all lists all options" +
               (command.commands.empty() ? ": " + std::to_string(command.options.size()) : " of a command") + ".\n";
    else if (!command.notes.empty())
        out += "\n" + command.notes + "\n";
    return out;
}

} // namespace gnomon::app
