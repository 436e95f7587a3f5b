// The program `gnomon-mpi`, which runs commands of `gnomon` on all processes of an MPI job together.

#include "app/commands.h"
#include "app/console.h"
#include "app/interruption.h"
#include "app/main_stack.h"
#include "app/program.h"
#include "core/error.h"
#include "core/printable.h"
#include "hierarchy/bytes.h"
#include "mpi/sun_team.h"
#include "preprocess/distributed/helper.h"
#include "preprocess/distributed/leader.h"
#include "settings/table.h"

#include <string_view>

namespace {

using namespace gnomon;

app::Program programOf(const app::BuildBy& buildBy, const std::shared_ptr<mpi::SunTeam>& team, bool isSilent) {
    return {
        "gnomon-mpi",
        "Run a command of gnomon on all processes of an MPI job: mpirun -n N gnomon-mpi COMMAND",
        {[buildBy](CLI::App& program) { app::addBuildCommand(program, buildBy); },
         [team](CLI::App& program) { app::addSunCommand(program, team); },
         [isSilent](CLI::App& program) { app::addManualCommand(program, isSilent); }},
        isSilent};
}

int lead(distributed::Mailbox& mailbox, int argc, char** argv) {
    distributed::Leader leader(mailbox);
    bool isDismissed = false;
    const auto build = [&](read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress) {
        if (options.isInMemory)
            throw settings::UsageError{
                "", "a build without temporary files works only in one process; use gnomon build"};
        pipeline::BuildReport report = buildModel(source, options, leader, progress);
        leader.dismiss();
        isDismissed = true;
        report.processes = leader.reports();
        report.processes.front().bytesRead = report.scratchRead;
        report.processes.front().tableBytes = report.tableBytes;
        report.processes.front().bytesWritten = report.scratchWritten;
        return std::optional(std::move(report));
    };
    const int code = app::exitCodeOf([&] {
        if (argc > 1 && std::string_view(argv[1]) == "bench")
            throw settings::UsageError{"", "bench works only in one process; use gnomon bench"};
        app::runProgram(programOf(build, std::make_shared<mpi::SunTeam>(mailbox), false), argc, argv);
    });
    if (!isDismissed) leader.dismiss();
    return code;
}

/// Runs a process of rank above 0. Always returns 0, because rank 0 (the leader) reports all errors and returns the
/// exit code of the job.
int help(distributed::Mailbox& mailbox, int argc, char** argv) {
    distributed::Helper helper(mailbox);
    const auto build = [&](read::MeshSource& source, const pipeline::BuildOptions& options, Progress& progress) {
        helper.serve(source, options, progress);
        return std::optional<pipeline::BuildReport>();
    };
    try {
        const auto team = std::make_shared<mpi::SunTeam>(mailbox, [&] { helper.noteStop(); });
        app::runProgram(programOf(build, team, true), argc, argv);
    } catch (const settings::UsageError& error) {
        helper.fail(error.message);
    } catch (const Interrupted&) {
        helper.fail("interrupted");
    } catch (const hierarchy::Damage& damage) {
        helper.fail("rank 0 sent a damaged message: " + damage.what);
    } catch (const std::exception& error) {
        helper.fail(inWords(error));
    }
    helper.leave();
    return 0;
}

int run(int argc, char** argv) {
    int code = 1;
    const int failed = app::exitCodeOf([&] {
        distributed::Mailbox mailbox(&argc, &argv);
        if (mailbox.rank() == 0) {
            app::endCleanlyOnSignals();
            code = lead(mailbox, argc, argv);
        } else {
            // The leader also reports signals for this process. mpirun sends a signal if the leader ends with an
            // error.
            app::onlyNoteSignals();
            code = help(mailbox, argc, argv);
        }
    });
    return failed != 0 ? failed : code;
}

} // namespace

int main(int argc, char** argv) {
    app::occupyStandardDescriptors();
    return app::onLargeStack([&] { return run(argc, argv); });
}
