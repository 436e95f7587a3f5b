// The subcommands of `gnomon`: each adds itself, its options and what it does to the command line.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/build_model.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace gnomon::measure {
class SunHoursTeam;
}

namespace gnomon::app {

/// Options of every subcommand.
struct CommonOptions {
    std::string progress = "auto"; // auto | bar | json | none
    int threads = 0;               // 0: all
};

/// Adds `--threads` and `--progress` to `command`.
void addCommonOptions(CLI::App& command, CommonOptions& options);

/// Whether work asks often enough to be stopped by Progress::advance; what does not ends by the signal itself.
enum class Polling : std::uint8_t { No, Yes };

/// The progress display that `options` ask for, on stderr; of work that polls it also turns Ctrl-C into
/// gnomon::Interrupted.
std::unique_ptr<Progress> makeProgress(const CommonOptions& options, Polling polling = Polling::Yes);

/// What an option for memory takes: 512M, 2G.
CLI::Validator memorySize();

/// Adds --cacert and --http-cache, by which the process reads what lies on servers.
void addServerOptions(CLI::App& command);

/// Adds MODEL, the name of a .gnm that is read, and those.
void addModel(CLI::App& command, std::string& model);

void addBenchCommand(CLI::App& program);

/// How a command builds: nothing comes back to a process that only helped another.
using BuildBy = std::function<std::optional<pipeline::BuildReport>(
    read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress)>;

/// Without `buildBy` by this process alone.
void addBuildCommand(CLI::App& program, const BuildBy& buildBy = {});
void addExplainCommand(CLI::App& program);
void addExportCommand(CLI::App& program);
void addInfoCommand(CLI::App& program);
void addMakeCommand(CLI::App& program);
void addManualCommand(CLI::App& program, bool isSilent = false); // silent where another process prints
void addMeasureCommand(CLI::App& program);
void addPathCommand(CLI::App& program);
void addRenderCommand(CLI::App& program);

/// Without `team` by this process alone; with it hours of sun alone.
void addSunCommand(CLI::App& program, const std::shared_ptr<measure::SunHoursTeam>& team = {});
void addTheoryCommand(CLI::App& program);
void addVerifyCommand(CLI::App& program);
void addViewCommand(CLI::App& program);

} // namespace gnomon::app
