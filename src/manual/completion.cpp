#include "manual/completion.h"

#include <functional>

namespace gnomon::manual {

namespace {

/// Returns `text` in single quotes for a shell. Each single quote in the text is replaced by `quote`.
std::string shellQuoted(const std::string& text, const std::string& quote = R"('\'')") {
    std::string out = "'";
    for (const char c : text)
        out += c == '\'' ? quote : std::string(1, c == '\n' ? ' ' : c);
    return out + "'";
}

std::string spaced(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "" : " ") + word;
    return all;
}

std::vector<std::string> namesBelow(const CommandWords& command) {
    std::vector<std::string> names;
    for (const CommandWords& below : command.commands)
        names.push_back(below.path.back());
    return names;
}

void visit(const CommandWords& command, const std::function<void(const CommandWords&)>& what) {
    what(command);
    for (const CommandWords& below : command.commands)
        visit(below, what);
}

/// Escapes `text` for the zsh function _arguments, in which colons and brackets are separators.
std::string withinZsh(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == ':' || c == '[' || c == ']' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

void addZsh(const CommandWords& command, std::string& out) {
    out += joinedPath(command, "_gnomon", "_") + "() {\n";
    if (!command.commands.empty()) {
        out += "    if (( CURRENT > 2 )); then\n        shift words; (( CURRENT-- ))\n        case $words[1] in\n";
        for (const CommandWords& below : command.commands)
            out += "            " + below.path.back() + ") " + joinedPath(below, "_gnomon", "_") + "; return ;;\n";
        out += "        esac\n    fi\n    local -a commands\n    commands=(\n";
        for (const CommandWords& below : command.commands)
            out += "        " + shellQuoted(below.path.back() + ":" + withinZsh(below.description)) + "\n";
        out += "    )\n    _describe command commands\n";
    }
    out += "    _arguments";
    for (const OptionWords& option : command.options)
        for (const std::string& name : option.names) {
            std::string spec = name + "[" + withinZsh(option.description) + "]";
            if (!option.choices.empty())
                spec += ":value:(" + spaced(option.choices) + ")";
            else if (!option.value.empty())
                spec += ":value:_files";
            out += " \\\n        " + shellQuoted(spec);
        }
    if (command.commands.empty()) out += " \\\n        '*:file:_files'";
    out += "\n}\n\n";
}

/// Returns the condition, in the syntax of fish, under which fish offers the subcommands and options of `command`.
std::string fishCondition(const CommandWords& command) {
    std::string condition;
    for (const std::string& word : command.path)
        condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
    if (!command.commands.empty())
        condition +=
            (condition.empty() ? "not __fish_seen_subcommand_from " : "; and not __fish_seen_subcommand_from ") +
            spaced(namesBelow(command));
    return condition.empty() ? "true" : condition;
}

} // namespace

std::string bashCompletion(const CommandWords& program) {
    std::string paths;
    std::string values;
    std::string words;
    visit(program, [&](const CommandWords& command) {
        const auto atPath = [path = spaced(command.path)](const std::string& word) {
            std::string text = "'";
            return text.append(path).append(":").append(word).append("'");
        };
        for (const std::string& below : namesBelow(command))
            paths.append(paths.empty() ? "" : "|").append(atPath(below));
        std::vector<std::string> options;
        for (const OptionWords& option : command.options)
            for (const std::string& name : option.names) {
                options.push_back(name);
                if (!option.choices.empty())
                    values.append("        ")
                        .append(atPath(name))
                        .append(") choices=")
                        .append(shellQuoted(spaced(option.choices)))
                        .append(" ;;\n");
                else if (!option.value.empty())
                    values.append("        ").append(atPath(name)).append(") files=yes ;;\n");
            }
        words += "        '" + spaced(command.path) + "') options=" + shellQuoted(spaced(options)) +
                 " commands=" + shellQuoted(spaced(namesBelow(command))) + " ;;\n";
    });
    return R"(_gnomon() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
    local path="" word choices="" files="" options="" commands=""
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case "$path:$word" in
        )" +
           paths + R"() path="${path:+$path }$word" ;;
        esac
    done
    case "$path:$previous" in
)" + values +
           R"(    esac
    case "$path" in
)" + words +
           R"(    esac
    if [[ -n $choices ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
    elif [[ $current == -* && -z $files ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    elif [[ -n $commands && -z $files ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    fi
}
complete -o filenames -F _gnomon gnomon
)";
}

std::string zshCompletion(const CommandWords& program) {
    std::string out = "#compdef gnomon\n\n";
    visit(program, [&](const CommandWords& command) { addZsh(command, out); });
    return out + "_gnomon \"$@\"\n";
}

std::string fishCompletion(const CommandWords& program) {
    std::string out;
    const auto asItIs = [](const std::string& text) { return shellQuoted(text, "\\'"); };
    visit(program, [&](const CommandWords& command) {
        const std::string start = "complete -c gnomon -n " + asItIs(fishCondition(command));
        for (const CommandWords& below : command.commands)
            out += start + " -f -a " + below.path.back() + " -d " + asItIs(below.description) + "\n";
        for (const OptionWords& option : command.options) {
            out += start;
            for (const std::string& name : option.names)
                out += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.choices.empty())
                out += " -x -a " + asItIs(spaced(option.choices));
            else if (!option.value.empty())
                out += " -r";
            out += " -d " + asItIs(option.description) + "\n";
        }
    });
    return out;
}

} // namespace gnomon::manual
