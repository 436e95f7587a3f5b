// The command `gnomon measure`, which computes distances, heights, angles and areas of points, like the window.

#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/thread_limit.h"
#include "settings/codec.h"
#include "task/measured_points.h"

#include <cstdio>

namespace gnomon::app {

namespace {

struct MeasureOptions {
    CommonOptions common;
    SettingOptions settings;
    task::PointTask task;
    std::vector<std::string> points, pixels;
    bool json = false, csv = false;
};

glm::ivec2 pixelOf(const std::string& text, const std::array<int, 2>& size) {
    const std::vector<std::string> items = settings::listItems("--pixel", text);
    if (items.size() != 2) settings::refuse("--pixel", text, "X,Y, column and row from the upper left");
    return {
        settings::parsed(settings::whole(0, size[0] - 1), "--pixel", items[0]),
        settings::parsed(settings::whole(0, size[1] - 1), "--pixel", items[1])};
}

void runMeasure(const MeasureOptions& options) {
    const ThreadLimit limit(options.common);
    task::PointTask task = options.task;
    task.settings = options.settings.settings();
    task.warn = printWarning;
    requireNoWindow(task.settings);
    for (const std::string& point : options.points)
        task.points.push_back(settings::parsed(settings::vector(), "--point", point));
    for (const std::string& pixel : options.pixels)
        task.pixels.push_back(pixelOf(pixel, task.settings.imageSize));
    if (task.points.empty() == task.pixels.empty())
        throw settings::UsageError{"--point", "measure needs points: give --point X,Y,Z or --pixel X,Y once per point"};
    if (task.takesVertices && task.pixels.empty())
        throw settings::UsageError{"--vertices", "--vertices needs --pixel X,Y"};
    const auto progress = makeProgress(options.common, Polling::No);
    progress->stage("measure", "points", task.points.size() + task.pixels.size());
    const auto [of, measure] = task::measurePoints(task);
    progress->advance(measure.size());
    std::string text;
    for (const std::string& line : inspect::inWords(measure, of))
        text += line + "\n";
    if (options.json) text = inspect::jsonOf(std::span(&measure, 1), of);
    if (options.csv) text = inspect::csvOf(std::span(&measure, 1), of);
    std::fputs(text.c_str(), stdout);
}

} // namespace

void addMeasureCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("measure", "Measure lengths, heights, angles and areas between points");
    auto options = std::make_shared<MeasureOptions>();
    addModel(*command, options->task.model);
    const auto addPlaces = [&](const char* name, std::vector<std::string>& places, const char* help) {
        return command->add_option(name, places, help)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    };
    addPlaces("--point", options->points, "Point in coordinates of the source; once per point")->type_name("X,Y,Z");
    addPlaces("--pixel", options->pixels, "Point of the surface in this pixel; once per point")->type_name("X,Y");
    command->add_flag("--vertices", options->task.takesVertices, "Replace each --pixel by the nearest drawn vertex");
    CLI::Option* json = command->add_flag("--json", options->json, "Print one JSON document on stdout");
    command->add_flag("--csv", options->csv, "Print one CSV row per point on stdout")->excludes(json);
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->footer("Points are on the grid of the model. `within` is the max distance of a point from the surface\n"
                    "of the source.");
    command->callback([options] { runMeasure(*options); });
}

} // namespace gnomon::app
