#include "app/option_text.h"
#include "app/thread_limit.h"
#include "app/view/key_table.h"
#include "app/view/viewer.h"
#include "core/error.h"

#include <memory>

namespace gnomon::app {

namespace {

/// The keys and what the mouse does, for the end of the help.
std::string keysForPeople() {
    std::string text = "Keys:\n";
    const auto add = [&](std::string name, const char* help) {
        name.resize(std::max<std::size_t>(name.size() + 2, 14), ' ');
        text += "  " + name + help + "\n";
    };
    for (const view::Binding& binding : view::bindings())
        add(binding.keyName, binding.help);
    text += "Mouse:\n";
    for (const view::MouseUse& use : view::mouseUses())
        add(use.gesture, use.help);
    return text;
}

} // namespace

void addViewCommand(CLI::App& program) {
    struct Options {
        CommonOptions common;
        view::ViewerOptions viewer;
        std::string frames;
    };

    CLI::App* command = program.add_subcommand("view", "Walk through a model in a window; H there lists the keys");
    auto options = std::make_shared<Options>();
    view::ViewerOptions& viewer = options->viewer;
    command->add_option("MODEL", viewer.file, "A .gnm, or a mesh: it is built into MESH.gnm beside it")->required();
    command->add_option("--target-ms", viewer.targetMs, "Give up detail and maps to hold this frame time; 0 is none")
        ->check(CLI::Range(0.0, 10000.0))
        ->capture_default_str();
    command->add_option("--path", viewer.path, "Play this camera path from the start");
    CLI::Option* frames =
        command->add_option("--frames", options->frames, "Play it in so many frames, as bench does, not by the clock");
    command->add_option("--images", viewer.images, "Write each played frame into this folder");
    command->add_option("--csv", viewer.csv, "Write a row per frame here, in the columns of bench");
    command->add_option("--build-memory", viewer.buildMemory, "Peak resident size while a mesh is built")
        ->capture_default_str();
    addViewOptions(*command, viewer.view);
    addCommonOptions(*command, options->common);
    frames->needs("--path");
    command->footer(keysForPeople());
    command->callback([options] {
        view::ViewerOptions& chosen = options->viewer;
        if (!options->frames.empty()) chosen.frames = parseWhole("--frames", options->frames, 1, 1000000);
        parseMemory("--build-memory", chosen.buildMemory);
        chosen.threads = options->common.threads;
        const ThreadLimit limit(options->common);
        view::runViewer(chosen);
    });
}

} // namespace gnomon::app
