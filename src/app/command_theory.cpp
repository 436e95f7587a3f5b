#include "app/commands.h"
#include "app/theory_rows.h"
#include "core/error.h"
#include "core/file.h"

#include <cstdio>
#include <memory>

namespace gnomon::app {

namespace {

nlohmann::json parsedFile(const std::string& path) {
    try {
        return nlohmann::json::parse(readTextFile(path));
    } catch (const nlohmann::json::parse_error& error) {
        throw Error(atByte(path, error.byte), "not JSON", "a JSON document", "a syntax error");
    }
}

void addEval(CLI::App& theory) {
    struct Options {
        std::string rows;
        std::string output;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command = theory.add_subcommand("eval", "Answer rows of theory inputs, as the golden rows are made");
    command->add_option("ROWS.json", options->rows, R"({"rows": [{"id", "family", "inputs"}, ...]})")->required();
    command->add_option("-o,--output", options->output, "Write the answers here instead of stdout");
    command->callback([options] {
        const std::string text = evaluateTheoryRows(parsedFile(options->rows), options->rows).dump(1) + "\n";
        if (options->output.empty())
            std::fputs(text.c_str(), stdout);
        else
            writeTextFile(options->output, text);
    });
}

} // namespace

void addTheoryCommand(CLI::App& program) {
    CLI::App* theory = program.add_subcommand("theory", "The shadow theory by itself: equations, figures, tables");
    theory->require_subcommand(1);
    addEval(*theory);
}

} // namespace gnomon::app
