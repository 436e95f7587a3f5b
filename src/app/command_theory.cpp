#include "app/commands.h"
#include "app/console.h"
#include "app/thread_limit.h"
#include "core/angle.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_file.h"
#include "core/prepared_output.h"
#include "core/printable.h"
#include "settings/codec.h"
#include "settings/files/named_files.h"
#include "telemetry/json_text.h"
#include "theory/embedded_files.h"
#include "theory/figures.h"
#include "theory/rows.h"
#include "theory/scheme_table.h"
#include "theory/theory_json.h"

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::app {

namespace {

using nlohmann::json;

void addEval(CLI::App& theory) {
    struct Options {
        CommonOptions common;
        std::string rows;
        std::string output;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command = theory.add_subcommand("eval", "Evaluate the equations for rows of inputs");
    command->add_option("ROWS.json", options->rows, R"(Inputs: {"rows": [{"id", "family", "inputs"}, ...]})")
        ->required();
    command->add_option("-o,--output", options->output, "Write the results to a file, not to stdout")
        ->type_name("OUT.json");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const ThreadLimit limit(options->common);
        settings::requireDistinctFiles({{"ROWS.json", options->rows}}, {{"--output", options->output}});
        const std::string text =
            telemetry::jsonText(theory::evaluateRows(readJsonFile(options->rows), options->rows), 1) + "\n";
        if (options->output.empty())
            std::fputs(text.c_str(), stdout);
        else
            writeTextFile(options->output, text);
    });
}

/// Runs the interpreter `python` with `arguments` and discards its stdout. Returns the exit status, or 127 if the
/// program does not exist.
int runQuietly(const std::string& python, std::vector<std::string> arguments, bool showErrors) {
    std::vector<char*> argv;
    arguments.insert(arguments.begin(), python);
    argv.reserve(arguments.size() + 1);
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw Error(python, "cannot start the process");
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGTERM); // ends the child if this process is killed
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        ::dup2(nowhere, STDOUT_FILENO);
        if (!showErrors) ::dup2(nowhere, STDERR_FILENO);
        ::execvp(python.c_str(), argv.data());
        ::_exit(127);
    }
    int status = 0;
    pid_t ended = -1;
    do
        ended = ::waitpid(child, &status, 0);
    while (ended < 0 && errno == EINTR);
    if (ended != child) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// Returns the path of a Python interpreter that has matplotlib: the first on the PATH, else /usr/bin/python3, else
/// nullopt.
std::optional<std::string> plottingPython() {
    for (const char* python : {"python3", "/usr/bin/python3"})
        if (runQuietly(python, {"-c", "import matplotlib"}, false) == 0) return python;
    return std::nullopt;
}

void writeFigures(const std::string& folder) {
    const PreparedFolder prepared(folder);
    const std::string shown = printable(folder);
    std::vector<theory::Figure> figures = theory::paperFigures();
    for (const auto& more : {theory::ownFigures(), theory::ulpsFigures()})
        figures.insert(figures.end(), more.begin(), more.end());
    json list = json::array();
    for (const theory::Figure& figure : figures) {
        writeTextFile(folder + "/" + figure.name + ".csv", theory::csvOf(figure));
        list.push_back(theory::describe(figure));
        std::printf("%s/%s.csv\n", shown.c_str(), figure.name.c_str());
    }
    writeTextFile(folder + "/figures.json", telemetry::jsonText(list, 1) + "\n");
    const std::string script = folder + "/theory_figures.py";
    writeTextFile(script, std::string(theory::kFiguresScript));
    const std::optional<std::string> python = plottingPython();
    if (!python) {
        printMessage("wrote the CSV files, but no SVG and PNG; install python3-matplotlib, then run python3 " + script);
        return;
    }
    if (runQuietly(*python, {script, folder}, true) != 0) throw Error(script, "the script that draws the plots failed");
    for (const theory::Figure& figure : figures)
        std::printf("%s/%s.svg\n%s/%s.png\n", shown.c_str(), figure.name.c_str(), shown.c_str(), figure.name.c_str());
    requirePrinted("the files in " + folder + " are complete");
}

void addFigures(CLI::App& theory) {
    struct Options {
        CommonOptions common;
        std::string folder;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command =
        theory.add_subcommand("figures", "Write the figures of the paper and of Gnomon as CSV, SVG and PNG");
    command->add_option("-o,--output", options->folder, "Folder to write")->required()->type_name("DIR");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const ThreadLimit limit(options->common);
        writeFigures(options->folder);
    });
}

struct TableOptions {
    CommonOptions common;
    shadow::ViewFrustum frustum;
    double fovYDegrees = 60;
    std::string light;
    bool asJson = false;
};

void printTable(const TableOptions& options) {
    shadow::ViewFrustum frustum = options.frustum;
    frustum.halfFovYRadians = radiansFromDegrees(options.fovYDegrees / 2);
    try {
        shadow::requireValid(frustum);
    } catch (const Error& error) {
        throw settings::UsageError{"", error.what()}; // all values come from options
    }
    const glm::dvec3 light = glm::normalize(settings::parsed(settings::direction(), "--light", options.light));
    const std::vector<theory::SchemeRow> table = theory::schemeTable(frustum, light);
    if (options.asJson) {
        std::printf("%s\n", telemetry::jsonText(theory::tableJson(table), 1).c_str());
        return;
    }
    std::printf("%-10s %-8s %2s %5s %14s %12s %12s\n", "scheme", "warp", "k", "maps", "S", "M_x", "M_z");
    for (const theory::SchemeRow& row : table)
        std::printf(
            "%-10s %-8s %2d %5zu %14.6g %12.6g %12.6g\n",
            row.scheme.c_str(),
            row.warp.c_str(),
            row.slices,
            row.maps,
            row.storageFactor,
            row.worstX,
            row.worstZ);
}

void addTable(CLI::App& theory) {
    auto options = std::make_shared<TableOptions>();
    CLI::App* command =
        theory.add_subcommand("table", "Print the storage factor and the errors M_x and M_z of all schemes");
    command->add_option("--near", options->frustum.near, "Near depth of the view frustum")->required()->type_name("N");
    command->add_option("--far", options->frustum.far, "Far depth of the view frustum")->required()->type_name("F");
    command->add_option("--fov-y", options->fovYDegrees, "Full vertical angle of view in degrees")
        ->required()
        ->type_name("DEG");
    command->add_option("--light", options->light, "Direction to the light in camera space: right,up,view")
        ->type_name("x,y,z")
        ->required();
    command->add_option("--aspect", options->frustum.aspect, "Width of the image divided by its height")
        ->type_name("A")
        ->capture_default_str();
    command->add_flag("--json", options->asJson, "Print one JSON document on stdout");
    command->footer(
        "auto* is auto with the best orientation of the map about the light; all other rows use the default\n"
        "orientation. log has logarithmic rows; with faces (FP) its values are lower bounds.");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const ThreadLimit limit(options->common);
        printTable(*options);
    });
}

} // namespace

void addTheoryCommand(CLI::App& program) {
    CLI::App* theory = program.add_subcommand("theory", "Compute tables and figures of the shadow theory");
    theory->require_subcommand(1);
    addEval(*theory);
    addFigures(*theory);
    addTable(*theory);
}

} // namespace gnomon::app
