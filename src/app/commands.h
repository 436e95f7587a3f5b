// The subcommands of `gnomon`. Each function adds one subcommand to the program, with its options and its action.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/build_model.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace gnomon::task {
class SunHoursTeam;
}

namespace gnomon::app {

/// The options that most subcommands share.
struct CommonOptions {
    std::string progress = "auto"; // auto | bar | json | none
    int threads = 0;               // 0: all cores
};

/// Adds `--threads` and `--progress` to `command`.
void addCommonOptions(CLI::App& command, CommonOptions& options);

/// Tells whether a command can stop by itself after Ctrl-C. Yes: the command calls Progress::advance often, and an
/// exception from there stops it. No: a signal ends the process at once.
enum class Polling : std::uint8_t { No, Yes };

/// Returns the progress display that `options` select, which writes to stderr. With Polling::Yes, its `advance` throws
/// gnomon::Interrupted after the first Ctrl-C.
std::unique_ptr<Progress> makeProgress(const CommonOptions& options, Polling polling = Polling::Yes);

/// Returns a validator for memory sizes on the command line, such as 512M or 2G.
CLI::Validator memorySize();

/// Adds --cacert and --http-cache, the options for models on web servers.
void addServerOptions(CLI::App& command);

/// Adds the argument MODEL, the path or web address of a .gnm file, and the options for web servers.
void addModel(CLI::App& command, std::string& model);

void addBenchCommand(CLI::App& program);

/// A function that builds a model. It returns nullopt in a process of an MPI job that only worked for another process.
using BuildBy = std::function<std::optional<pipeline::BuildReport>(
    read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress)>;

/// Adds the command `gnomon build`. `buildBy` builds the model. Without it, this process builds the model alone.
void addBuildCommand(CLI::App& program, const BuildBy& buildBy = {});
void addExplainCommand(CLI::App& program);
void addExportCommand(CLI::App& program);
void addInfoCommand(CLI::App& program);
void addMakeCommand(CLI::App& program);
void addManualCommand(CLI::App& program, bool isSilent = false); // silent: another process prints the page
void addMeasureCommand(CLI::App& program);
void addPathCommand(CLI::App& program);
void addRenderCommand(CLI::App& program);

/// Adds the command `gnomon sun`. With `team`, it has only the subcommand `hours`, which all processes of the team
/// compute together. Otherwise it has all subcommands, and this process computes alone.
void addSunCommand(CLI::App& program, const std::shared_ptr<task::SunHoursTeam>& team = {});
void addTheoryCommand(CLI::App& program);
void addVerifyCommand(CLI::App& program);
void addViewCommand(CLI::App& program);

} // namespace gnomon::app
