#include "manual/man_page.h"

#include <algorithm>
#include <cctype>

namespace gnomon::manual {

namespace {

/// Escapes `text` for roff, so that no line is read as a request and no character starts an escape sequence.
std::string plain(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const bool startsLine = out.empty() || out.back() == '\n';
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            if (startsLine && (c == '.' || c == '\'')) out += "\\&";
            out += c;
        }
    }
    return out;
}

std::string italic(const std::string& words) {
    return "\\fI" + words + "\\fR";
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

std::string choicesOf(const OptionWords& option) {
    std::string all;
    for (const std::string& choice : option.choices)
        all += (all.empty() ? "" : "|") + choice;
    return all;
}

void addOption(std::string& out, const OptionWords& option, bool isArgument) {
    out += ".TP\n";
    std::string line;
    for (const std::string& name : option.names)
        line += (line.empty() ? "" : ", ") + ("\\fB" + plain(name) + "\\fR");
    const bool isBare = option.choices.empty() || option.value.find('|') != std::string::npos;
    const std::string value = isBare ? option.value : choicesOf(option);
    if (!isArgument && !value.empty()) line += " \\fI" + plain(value) + "\\fR";
    out += line + "\n" + plain(option.description);
    if (out.back() != '.') out += ".";
    if (!option.byDefault.empty()) out += "\nDefault: " + plain(option.byDefault) + ".";
    if (option.isRequired && !isArgument) out += "\nRequired.";
    out += "\n";
}

/// Appends the options of `command` to a manual page, with a heading per group.
void addOptions(std::string& out, const CommandWords& command) {
    out += ".SH OPTIONS\n";
    for (const settings::GroupNames& group : settings::kGroups) {
        bool isFirst = true;
        for (const OptionWords& option : command.options) {
            if (option.place.group != group.group) continue;
            if (isFirst) out += ".SS " + std::string(group.title) + "\n";
            addOption(out, option, false);
            isFirst = false;
        }
    }
}

/// Returns the first line of a command's description, because the NAME section of a manual page may have only one line.
std::string firstLine(const std::string& text) {
    std::string line = text.substr(0, text.find('\n'));
    if (!line.empty() && line.back() == '.') line.pop_back();
    return line;
}

} // namespace

std::string manPage(const CommandWords& command, const std::string& program, const std::string& version) {
    const std::string name = joinedPath(command, program, "-");
    std::string out = ".TH \"" + upper(plain(name)) + R"(" 1 "" "gnomon )" + version + "\" \"User Commands\"\n";
    out += ".SH NAME\n" + plain(name) + R"( \- )" + plain(firstLine(command.description)) + "\n";
    out += ".SH SYNOPSIS\n.B " + plain(joinedPath(command, program, " ")) + "\n";
    if (!command.options.empty()) out += "[" + italic("OPTIONS") + "]\n";
    for (const OptionWords& argument : command.arguments) {
        const std::string words = italic(plain(argument.names.front()));
        out += argument.isRequired ? words + "\n" : "[" + words + "]\n";
    }
    if (!command.commands.empty()) out += "\\fICOMMAND\\fR ...\n";
    out += ".SH DESCRIPTION\n" + plain(command.description) + "\n";
    if (!command.arguments.empty()) {
        out += ".SH ARGUMENTS\n";
        for (const OptionWords& argument : command.arguments)
            addOption(out, argument, true);
    }
    if (!command.commands.empty()) {
        out += ".SH COMMANDS\n";
        for (const CommandWords& below : command.commands)
            out += ".TP\n\\fB" + plain(below.path.back()) + "\\fR\n" + plain(below.description) + "\n";
    }
    addOptions(out, command);
    if (!command.notes.empty()) out += ".SH NOTES\n.nf\n" + plain(command.notes) + "\n.fi\n";
    out += ".SH EXIT STATUS\n0: success. 1: the work failed. 2: the command line is wrong.\n";
    std::string also;
    if (!command.path.empty()) also += ".BR " + plain(program) + " (1)";
    for (const CommandWords& below : command.commands)
        also += (also.empty() ? "" : ",\n") + (".BR " + plain(joinedPath(below, program, "-")) + " (1)");
    if (!also.empty()) out += ".SH SEE ALSO\n" + also + "\n";
    return out;
}

} // namespace gnomon::manual
