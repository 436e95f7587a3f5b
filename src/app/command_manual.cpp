#include "app/commands.h"
#include "manual/completion.h"
#include "manual/man_page.h"

#include <cstdio>

namespace gnomon::app {

void addManualCommand(CLI::App& program, bool isSilent) {
    struct Options {
        std::string format;
        std::vector<std::string> names;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("manual", "Print a manual page or a shell completion");
    command->group(""); // not in the help, because only makers of packages need it
    command->add_option("FORMAT", options->format, "Kind of output: man, bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
    command->add_option("COMMAND", options->names, "Command of the manual page");
    command->callback([options, &program, isSilent] {
        const manual::CommandWords words = manual::commandWords(program);
        std::string text;
        if (options->format == "man")
            text = manual::manPage(manual::commandAt(words, options->names), program.get_name(), GNOMON_VERSION);
        else if (options->format == "bash")
            text = manual::bashCompletion(words);
        else if (options->format == "zsh")
            text = manual::zshCompletion(words);
        else
            text = manual::fishCompletion(words);
        if (!isSilent) std::fputs(text.c_str(), stdout);
    });
}

} // namespace gnomon::app
