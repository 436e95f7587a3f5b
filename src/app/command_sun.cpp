// The command `gnomon sun`: the position of the Sun at a place and time, and the sun hours of a model.

#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/thread_limit.h"
#include "settings/files/named_files.h"
#include "settings/resolve.h"
#include "settings/sun_settings.h"
#include "sun/sun_day.h"
#include "task/sun_hours.h"
#include "telemetry/json_text.h"

#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

namespace gnomon::app {

namespace {

struct PositionOptions {
    std::string at;
    std::string time;
    double height = 0;
    sun::Air air;
    bool json = false;
    CommonOptions common;
};

using nlohmann::ordered_json;

void printPosition(const ordered_json& json, const sun::Air& air, bool upAtNoon) {
    const auto text = [&json, upAtNoon](const char* name) {
        return json[name].is_null() ? std::string(upAtNoon ? "none: the sun stays up" : "none: the sun stays down")
                                    : json[name].get<std::string>();
    };
    std::printf("azimuth    %9.4f  degrees from north by east\n", json["azimuth"].get<double>());
    std::printf("elevation  %9.4f  degrees, without refraction\n", json["elevation"].get<double>());
    std::printf(
        "           %9.4f  as seen through air of %g hPa and %g degrees Celsius\n",
        json["elevation_refracted"].get<double>(),
        air.pressure,
        air.temperature);
    for (const char* name : {"sunrise", "noon", "sunset"})
        std::printf("%-10s %s\n", name, text(name).c_str());
}

void runPosition(const PositionOptions& options) {
    sun::Place place = settings::parsed(settings::place(), "--at", options.at);
    place.height = options.height;
    const sun::CivilTime time = settings::parsed(settings::moment(), "--time", options.time);
    if (time.year < 1600 || time.year > 2600)
        printWarning("--time: the rotation of the Earth is an estimate outside the years 1600 to 2600");
    const sun::SunPosition position = sun::sunPosition(sun::julianDate(time), place, options.air);
    const sun::SunDay day = sun::sunDay(time, place, options.air);
    const auto moment = [&time](const std::optional<sun::JulianDate>& date) {
        return date ? ordered_json(sun::written(*date, time.offsetMinutes)) : ordered_json();
    };
    const ordered_json json = {
        {"azimuth", position.azimuth},
        {"elevation", position.elevation},
        {"elevation_refracted", position.elevationRefracted},
        {"sunrise", moment(day.sunrise)},
        {"noon", moment(day.noon)},
        {"sunset", moment(day.sunset)}};
    if (options.json)
        std::printf("%s\n", telemetry::jsonText(json, 1).c_str());
    else
        printPosition(json, options.air, day.upAtNoon);
}

struct HoursOptions {
    std::string at, from, to, step, error;
    SettingOptions settings;
    task::SunHoursTask task;
    bool isJson = false;
    CommonOptions common;
};

void runHours(HoursOptions options, task::SunHoursTeam& team) {
    const ThreadLimit threads(options.common);
    task::SunHoursTask task = options.task;
    task.team = &team;
    if (!team.leads()) options.common.progress = "none";
    task.settings = options.settings.settings();
    settings::requireDirectionalLight(task.settings, "sun hours");
    task.warn = [&team](const std::string& warning) {
        if (team.leads()) printWarning(warning);
    };
    task.period.place = settings::parsed(settings::place(), "--at", options.at);
    task.period.from = settings::parsed(settings::moment(), "--from", options.from);
    task.period.to = settings::parsed(settings::moment(), "--to", options.to);
    task.period.stepSeconds = settings::parsed(settings::duration(), "--step", options.step);
    task.period.northDegrees = task.settings.north.value_or(0);
    if (!options.error.empty()) task.error = settings::parsed(settings::positiveNumber(), "--error", options.error);
    const bool isOfView = task.points.empty() && !task.isOfVertices;
    if (isOfView && task.error)
        throw settings::UsageError{"--error", "--error needs --points or --vertices; use --error-pixels for a view"};
    if (!isOfView && !(task.pfm + task.report).empty())
        throw settings::UsageError{"--pfm", "--pfm and --report need a view; remove --points and --vertices"};
    if (!task.points.empty() && (task.csv.empty() || !task.output.empty()))
        throw settings::UsageError{"--points", "--points needs --csv FILE.csv as the only output"};
    if (task.isOfVertices && (task.output.empty() || !task.csv.empty()))
        throw settings::UsageError{"--vertices", "--vertices needs -o OUT.ply as the only output"};
    if ((task.output + task.pfm + task.csv + task.report).empty())
        throw settings::UsageError{
            "--output", "sun hours needs an output: -o IMAGE.png, --pfm FILE, --csv FILE or --report DIR"};
    settings::requireExtension("--output", task.output, task.isOfVertices ? ".ply" : ".png");
    settings::requireDistinctFiles(
        {{"MODEL", task.model}, {"--camera", task.settings.cameraFile}, {"--points", task.points}},
        {{"--output", task.output}, {"--pfm", task.pfm}, {"--csv", task.csv}});
    const auto done = task::computeSunHours(task, *makeProgress(options.common));
    if (!done) return;
    if (!options.isJson) {
        std::fputs(task::summaryText(*done, task.period.stepSeconds).c_str(), stderr);
        return;
    }
    std::printf("%s\n", task::summaryJson(*done).c_str());
    requirePrinted("the requested files are complete");
}

void addPlace(CLI::App& command, std::string& place) {
    command.add_option("--at", place, "Latitude and longitude in degrees, north and east positive")
        ->required()
        ->type_name("LAT,LON");
}

void addHoursCommand(CLI::App& group, const std::shared_ptr<task::SunHoursTeam>& team) {
    auto options = std::make_shared<HoursOptions>();
    CLI::App* command = group.add_subcommand("hours", "Compute the hours of sun per point of a model over a period");
    task::SunHoursTask& task = options->task;
    addModel(*command, task.model);
    addPlace(*command, options->at);
    command->add_option("--from", options->from, "Start of the period, such as 2026-06-21T00:00+02:00")
        ->required()
        ->type_name("TIME");
    command->add_option("--to", options->to, "End of the period")->required()->type_name("TIME");
    command->add_option("--step", options->step, "Time between two positions of the Sun, such as 5m, 90s or 1h")
        ->required()
        ->type_name("TIME");
    command->add_option("-o,--output", task.output, "Picture of the hours with a legend, or a PLY with --vertices")
        ->type_name("FILE.png");
    command->add_option("--pfm", task.pfm, "Write the hours of each pixel; -1 is background")->type_name("FILE.pfm");
    command->add_option("--csv", task.csv, "Write position, hours, first and last sun of each point")
        ->type_name("FILE.csv");
    command->add_option("--report", task.report, "Write a web page with a slider over the times to a folder")
        ->type_name("DIR");
    CLI::Option* points =
        command->add_option("--points", task.points, "Compute for points: x,y,z per line, in place of a view");
    points->type_name("FILE.csv");
    command->add_flag("--vertices", task.isOfVertices, "Compute for all vertices, in place of a view")
        ->excludes(points);
    command
        ->add_option(
            "--error", options->error, "With --points or --vertices: max geometric error in units of the model")
        ->type_name("E")
        ->default_str("the finest level");
    command->add_flag("--resume", task.isResumed, "Continue a run that was killed");
    command->add_flag("--json", options->isJson, "Print a summary as one JSON document on stdout");
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->callback([options, team] { runHours(*options, *team); });
}

void addPositionCommand(CLI::App& group) {
    auto options = std::make_shared<PositionOptions>();
    CLI::App* command = group.add_subcommand("position", "Print the position of the Sun, sunrise and sunset");
    addPlace(*command, options->at);
    command->add_option("--time", options->time, "Date and time, such as 2026-06-21T12:00+02:00")
        ->required()
        ->type_name("TIME");
    command->add_option("--height", options->height, "Height above the WGS84 ellipsoid in metres")
        ->check(CLI::Range(-11000.0, 100000.0))
        ->type_name("M")
        ->capture_default_str();
    command->add_option("--pressure", options->air.pressure, "Air pressure in hPa; 0 is no refraction")
        ->check(CLI::Range(0.0, 2000.0))
        ->type_name("HPA")
        ->capture_default_str();
    command->add_option("--temperature", options->air.temperature, "Temperature in degrees Celsius")
        ->check(CLI::Range(-100.0, 100.0))
        ->type_name("C")
        ->capture_default_str();
    command->add_flag("--json", options->json, "Print one JSON document on stdout");
    addCommonOptions(*command, options->common);
    command->callback([options] { runPosition(*options); });
}

} // namespace

void addSunCommand(CLI::App& program, const std::shared_ptr<task::SunHoursTeam>& team) {
    CLI::App* group = program.add_subcommand("sun", "Compute the position of the Sun, or the hours of sun on a model");
    group->require_subcommand(1);
    if (!team) addPositionCommand(*group);
    addHoursCommand(*group, team ? team : std::make_shared<task::SunHoursTeam>());
}

} // namespace gnomon::app
