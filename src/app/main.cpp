// The program: one table of subcommands, one place where errors become exit codes.

#include "app/commands.h"
#include "app/console.h"
#include "app/interruption.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/process/floating_point.h"
#include "manual/version.h"
#include "settings/table.h"

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>

namespace {

using gnomon::app::printMessage;
using gnomon::settings::UsageError;

using AddCommand = void (*)(CLI::App&);

// In the order in which a user meets them, which is also the order of --help.
constexpr std::array kCommands{
    AddCommand{gnomon::app::addMakeCommand},
    AddCommand{gnomon::app::addBuildCommand},
    AddCommand{gnomon::app::addInfoCommand},
    AddCommand{gnomon::app::addVerifyCommand},
    AddCommand{gnomon::app::addExportCommand},
    AddCommand{gnomon::app::addPathCommand},
    AddCommand{gnomon::app::addRenderCommand},
    AddCommand{gnomon::app::addMeasureCommand},
    AddCommand{gnomon::app::addExplainCommand},
    AddCommand{gnomon::app::addBenchCommand},
    AddCommand{gnomon::app::addViewCommand},
    AddCommand{gnomon::app::addSunCommand},
    AddCommand{gnomon::app::addTheoryCommand},
    AddCommand{gnomon::app::addManualCommand},
};

/// What is wrong with the command line and whose help says what is right, in one line.
std::string usage(const CLI::App& program, const CLI::ParseError& error, const std::string& first) {
    const auto chosen = program.get_subcommands();
    if (chosen.empty() && !first.empty() && first.front() != '-')
        return "there is no command '" + first + "'; gnomon --help lists them";
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text + "; see gnomon " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help";
}

int run(int argc, char** argv) {
    CLI::App program("Low-error shadow maps for meshes of a million to a billion triangles.", "gnomon");
    CLI::Option* version = program.set_version_flag("--version", "gnomon " GNOMON_VERSION, "Print the version");
    bool isJson = false;
    program.add_flag("--json", isJson, "Beside --version: how the program was compiled, as JSON")->needs(version);
    program.require_subcommand(1);
    program.get_formatter()->column_width(38);
    for (const AddCommand add : kCommands)
        add(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForVersion&) {
        // Which of two flags is looked at first is the library's business.
        isJson =
            std::any_of(argv + 1, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
        std::cout << (isJson ? gnomon::manual::versionJson(GNOMON_VERSION) : "gnomon " GNOMON_VERSION) << '\n';
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw UsageError{usage(program, error, argc > 1 ? argv[1] : "")};
        program.exit(error); // prints what --help asks for
    }
    gnomon::app::requirePrinted();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    gnomon::app::occupyStandardDescriptors();
    gnomon::app::endCleanlyOnSignals();
    try {
        gnomon::requireUsualFloatingPoint();
        return run(argc, argv);
    } catch (const UsageError& error) {
        printMessage(error.message);
        return 2;
    } catch (const gnomon::Interrupted&) {
        printMessage(gnomon::app::kInterrupted);
        return 1;
    } catch (const gnomon::Error& error) {
        const std::string options = gnomon::settings::optionsOf(error.what());
        printMessage(error.what() + (options.empty() ? "" : "; see " + options));
        return 1;
    } catch (const std::bad_alloc&) {
        printMessage("out of memory");
        return 1;
    } catch (const std::exception& error) {
        printMessage(gnomon::inWords(error));
        return 1;
    }
}
