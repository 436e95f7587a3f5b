#include "app/program.h"

#include "app/console.h"
#include "app/help_text.h"
#include "app/interruption.h"
#include "app/option_errors.h"
#include "core/printable.h"
#include "core/process/floating_point.h"
#include "core/progress.h"
#include "manual/version.h"
#include "settings/removed_words.h"
#include "settings/usage_error.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <span>
#include <string_view>

namespace gnomon::app {

namespace {

/// Returns one line with the error in the command line and the command that prints help about it. `first` is the first
/// argument.
std::string usage(const CLI::App& program, const CLI::ParseError& error, const std::string& first) {
    const auto chosen = program.get_subcommands();
    if (chosen.empty() && !first.empty() && first.front() != '-')
        return "there is no command '" + first + "'; " + program.get_name() + " --help lists them";
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text + "; see " + program.get_name() + " " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") +
           "--help";
}

} // namespace

void runProgram(const Program& about, int argc, char** argv) {
    requireUsualFloatingPoint();
    CLI::App program(about.description, about.name);
    const std::string versionLine = std::string(about.name) + " " GNOMON_VERSION;
    program.set_help_flag("-h,--help", "Print the everyday options");
    program.set_help_all_flag("--help-all", "Print all options");
    CLI::Option* version = program.set_version_flag("--version", versionLine, "Print the version");
    bool isJson = false;
    program.add_flag("--json", isJson, "With --version: print how the program was compiled, as JSON")->needs(version);
    program.require_subcommand(1);
    program.formatter_fn([](const CLI::App* command, const std::string& name, CLI::AppFormatMode mode) {
        const auto detail = mode == CLI::AppFormatMode::All ? HelpDetail::All : HelpDetail::Everyday;
        return helpText(manual::commandWords(*command), name, detail);
    });
    for (const auto& add : about.commands)
        add(program);
    for (const char* const word : std::span(argv, static_cast<std::size_t>(argc)))
        settings::refuseRemovedOption(word);
    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForVersion&) {
        // CLI11 can process --version before --json, so --json is searched here.
        isJson =
            std::any_of(argv + 1, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
        if (!about.isSilent) std::cout << (isJson ? gnomon::manual::versionJson(GNOMON_VERSION) : versionLine) << '\n';
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw settings::UsageError{"", usage(program, error, argc > 1 ? argv[1] : "")};
        if (!about.isSilent) program.exit(error); // prints what --help asks for
    }
    requirePrinted();
}

int exitCodeOf(const std::function<void()>& work) {
    try {
        work();
        return 0;
    } catch (const settings::UsageError& error) {
        printMessage(error.message);
        return 2;
    } catch (const GatesFailed& error) {
        printMessage(error.what());
        return error.exitCode();
    } catch (const Interrupted&) {
        printMessage(kInterrupted);
        return 1;
    } catch (const LimitError& error) {
        printMessage(inOptions(error).what());
        return 1;
    } catch (const std::bad_alloc&) {
        printMessage("out of memory");
        return 1;
    } catch (const std::exception& error) {
        printMessage(inWords(error));
        return 1;
    }
}

} // namespace gnomon::app
