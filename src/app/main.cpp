// The program `gnomon`. Its subcommands are in the order of a typical use.

#include "app/commands.h"
#include "app/console.h"
#include "app/interruption.h"
#include "app/main_stack.h"
#include "app/program.h"

#ifdef GNOMON_CATCHES_EARLY_SIGNALS
namespace {

// The dynamic linker calls this function after it has loaded the libraries, before it initialises them.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a function is no data
__attribute__((section(".preinit_array"), used)) void (*const catchSignalsEarly)() = gnomon::app::catchSignals;

} // namespace
#endif

int main(int argc, char** argv) {
    using namespace gnomon::app;
    occupyStandardDescriptors();
    endCleanlyOnSignals();
    const auto run = [&] {
        runProgram(
            {"gnomon",
             "Draw meshes of a million to a billion triangles with correct shadows.",
             {addMakeCommand,
              [](CLI::App& program) { addBuildCommand(program); },
              addInfoCommand,
              addVerifyCommand,
              addExportCommand,
              addPathCommand,
              addRenderCommand,
              addMeasureCommand,
              addExplainCommand,
              [](CLI::App& program) { addBenchCommand(program); },
              addViewCommand,
              [](CLI::App& program) { addSunCommand(program); },
              addTheoryCommand,
              [](CLI::App& program) { addManualCommand(program); }}},
            argc,
            argv);
    };
    return onLargeStack([&] { return exitCodeOf(run); });
}
