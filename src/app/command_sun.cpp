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
        printWarning(
            "--time: outside the years from 1600 to 2600 how far the Earth's turn lags behind clocks is a guess");
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
        throw settings::UsageError{"--error", "--error is of --points and --vertices; of a view --error-pixels"};
    if (!isOfView && !(task.pfm + task.report).empty())
        throw settings::UsageError{"--pfm", "--pfm and --report are of a view"};
    if (!task.points.empty() && (task.csv.empty() || !task.output.empty()))
        throw settings::UsageError{"--points", "--points writes --csv FILE, and nothing else"};
    if (task.isOfVertices && (task.output.empty() || !task.csv.empty()))
        throw settings::UsageError{"--vertices", "--vertices writes -o OUT.ply, and nothing else"};
    if ((task.output + task.pfm + task.csv + task.report).empty())
        throw settings::UsageError{
            "--output", "sun hours writes nothing: say -o IMAGE.png, --pfm FILE, --csv FILE or --report DIR"};
    settings::requireExtension("--output", task.output, task.isOfVertices ? ".ply" : ".png");
    settings::requireApart(
        {{"MODEL", task.model}, {"--camera", task.settings.cameraFile}, {"--points", task.points}},
        {{"--output", task.output}, {"--pfm", task.pfm}, {"--csv", task.csv}});
    const auto done = task::computeSunHours(task, *makeProgress(options.common));
    if (!done) return;
    if (!options.isJson) {
        std::fputs(task::summaryText(*done, task.period.stepSeconds).c_str(), stderr);
        return;
    }
    std::printf("%s\n", task::summaryJson(*done).c_str());
    requirePrinted("the files that were asked for are complete");
}

void addHoursCommand(CLI::App& group, const std::shared_ptr<task::SunHoursTeam>& team) {
    auto options = std::make_shared<HoursOptions>();
    CLI::App* command = group.add_subcommand("hours", "Count the hours of sun over a period, by exact shadows");
    task::SunHoursTask& task = options->task;
    addModel(*command, task.model);
    command->add_option("--at", options->at, "LAT,LON in degrees, north and east positive")->required();
    command->add_option("--from", options->from, "ISO 8601 with an offset: 2026-06-21T00:00+02:00")->required();
    command->add_option("--to", options->to, "The period's end, likewise")->required();
    command->add_option("--step", options->step, "How often it is looked, such as 5m, 90s or 1h")->required();
    command->add_option("-o,--output", task.output, "Hours as colours, with a legend")->type_name("FILE.png");
    command->add_option("--pfm", task.pfm, "Hours of each pixel; -1 where nothing is")->type_name("FILE.pfm");
    command->add_option("--csv", task.csv, "Each point: where, steps, hours, first and last sun")
        ->type_name("FILE.csv");
    command->add_option("--report", task.report, "A page with a slider over the times")->type_name("DIR");
    CLI::Option* points =
        command->add_option("--points", task.points, "Of points instead: lines that begin with x,y,z");
    points->type_name("FILE.csv");
    command->add_flag("--vertices", task.isOfVertices, "Of all vertices of a level of detail; -o is a PLY")
        ->excludes(points);
    command->add_option("--error", options->error, "Of --points, --vertices: the level's error, world units [finest]");
    command->add_flag("--resume", task.isResumed, "Go on with what a killed run left");
    command->add_flag("--json", options->isJson, "Print what was counted as JSON on stdout");
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->callback([options, team] { runHours(*options, *team); });
}

void addPositionCommand(CLI::App& group) {
    auto options = std::make_shared<PositionOptions>();
    CLI::App* command = group.add_subcommand("position", "Where the sun stands at a time, when it rises and sets");
    command->add_option("--at", options->at, "LAT,LON in degrees, north and east positive")->required();
    command->add_option("--time", options->time, "ISO 8601 with an offset: 2026-06-21T12:00+02:00")->required();
    command->add_option("--height", options->height, "Metres above the ellipsoid of WGS 84, default 0")
        ->check(CLI::Range(-11000.0, 100000.0));
    command->add_option("--pressure", options->air.pressure, "Hectopascals, default 1010; 0: no refraction")
        ->check(CLI::Range(0.0, 2000.0));
    command->add_option("--temperature", options->air.temperature, "Degrees Celsius, default 10")
        ->check(CLI::Range(-100.0, 100.0));
    command->add_flag("--json", options->json, "Print one JSON document");
    addCommonOptions(*command, options->common);
    command->callback([options] { runPosition(*options); });
}

} // namespace

void addSunCommand(CLI::App& program, const std::shared_ptr<task::SunHoursTeam>& team) {
    CLI::App* group = program.add_subcommand("sun", "Tell where the sun stands, and how long it shines on what");
    group->require_subcommand(1);
    if (!team) addPositionCommand(*group);
    addHoursCommand(*group, team ? team : std::make_shared<task::SunHoursTeam>());
}

} // namespace gnomon::app
