// The program `gnomon`: its subcommands, in the order in which a user meets them.

#include "app/commands.h"
#include "app/console.h"
#include "app/interruption.h"
#include "app/program.h"

int main(int argc, char** argv) {
    using namespace gnomon::app;
    occupyStandardDescriptors();
    endCleanlyOnSignals();
    return exitCodeOf([&] {
        runProgram(
            {"gnomon",
             "Low-error shadow maps for meshes of a million to a billion triangles.",
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
    });
}
