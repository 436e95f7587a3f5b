// The program: one table of subcommands, one place where errors become exit codes.

#include "app/commands.h"
#include "core/error.h"
#include "settings/option_text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

namespace {

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
    AddCommand{gnomon::app::addExplainCommand},
    AddCommand{gnomon::app::addBenchCommand},
    AddCommand{gnomon::app::addViewCommand},
    AddCommand{gnomon::app::addTheoryCommand},
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

/// Throws Error if something that was printed has not reached stdout.
void requirePrinted() {
    std::cout.flush(); // --help and --version
    if (std::fflush(stdout) != 0) throw gnomon::Error("stdout", std::string("cannot write: ") + std::strerror(errno));
    if (!std::cout.good() || std::ferror(stdout) != 0)
        throw gnomon::Error("stdout", "cannot write: some of the output is lost");
}

int run(int argc, char** argv) {
    CLI::App program("Low-error shadow maps for meshes of a million to a billion triangles.", "gnomon");
    program.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    program.require_subcommand(1);
    program.get_formatter()->column_width(38);
    for (const AddCommand add : kCommands)
        add(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw UsageError{usage(program, error, argc > 1 ? argv[1] : "")};
        program.exit(error); // prints what --help and --version ask for
    }
    requirePrinted();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const UsageError& error) {
        std::fprintf(stderr, "gnomon: %s\n", error.message.c_str());
        return 2;
    } catch (const gnomon::Interrupted&) {
        std::fprintf(stderr, "gnomon: interrupted; nothing was left half-written\n");
        return 1;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "gnomon: out of memory\n");
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon: %s\n", error.what());
        return 1;
    }
}
