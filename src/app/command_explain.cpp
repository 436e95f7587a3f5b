// The command `gnomon explain`, which prints the passes and shadow maps of one frame, with a reason for each skipped
// effect.

#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/thread_limit.h"
#include "settings/plan_json.h"
#include "settings/resolve.h"
#include "task/session.h"
#include "telemetry/json_text.h"

#include <cstdio>
#include <memory>

namespace gnomon::app {

namespace {

struct ExplainOptions {
    CommonOptions common;
    SettingOptions settings;
    std::string model;
    bool json = false;
};

void runExplain(const ExplainOptions& options) {
    settings::Settings settings = options.settings.settings();
    const plan::Quality quality = settings::qualityOf(settings);
    const settings::BackendChoice backend = task::backendFor(settings, settings::DrawingCommand::Render);
    settings.backend = settings::Backend::Software; // explain draws nothing, so it needs no OpenGL context
    task::Session session(options.model, settings, printWarning);
    session.renderer().planFor(settings::capabilitiesOf(backend.backend));
    const plan::FramePlan plan = session.renderer().plan(settings::viewOf(settings, session.model()), quality);
    const std::string text = options.json ? telemetry::jsonText(settings::planJson(plan, backend), 1) + "\n"
                                          : settings::planText(plan, backend);
    std::fputs(text.c_str(), stdout);
}

} // namespace

void addExplainCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "explain", "Print the plan of a frame: its passes, and the reason for each skipped pass");
    auto options = std::make_shared<ExplainOptions>();
    addModel(*command, options->model);
    command->add_flag("--json", options->json, "Print one JSON document on stdout");
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->footer(
        "The aliasing bound is the max perspective aliasing from --shadow-near to --shadow-far: the width of\n"
        "a texel divided by the width of a pixel. `sheared` is the bound in z with the shear of the texel.");
    command->callback([options] {
        const ThreadLimit limit(options->common);
        runExplain(*options);
    });
}

} // namespace gnomon::app
