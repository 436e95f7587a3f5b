#include "bench/bench_runs.h"

#include "settings/backend_choice.h"
#include "settings/resolve.h"
#include "settings/table.h"

#include <algorithm>
#include <span>
#include <utility>

namespace gnomon::bench {

namespace {

/// Returns four times the absolute difference of each channel, at most 255.
render::Picture magnifiedDifference(const render::Picture& a, const render::Picture& b) {
    render::Picture result = a;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const int difference = std::abs(a.pixels[i][channel] - b.pixels[i][channel]);
            result.pixels[i][channel] = static_cast<std::uint8_t>(std::min(255, 4 * difference));
        }
    return result;
}

/// Returns `text` followed by `more`, with `separator` between them if both are not empty.
std::string joined(std::string text, const char* separator, const std::string& more) {
    if (!text.empty() && !more.empty()) text += separator;
    return text + more;
}

/// Adds `setting` of `own` to the parts of the run's name. `varies` is true if other runs have another value.
void addToName(
    BenchRun& run, const settings::Setting& setting, const settings::Settings& own, bool varies, bool isGiven) {
    const std::string value = setting.text(own);
    const std::string named = setting.column() + ":" + value;
    const bool isError = setting.name() == "error-pixels";
    if (isError) run.error = varies || isGiven ? value + "px" : "default";
    if (!isError && setting.name() != "shadows" && (varies || isGiven)) run.scheme = joined(run.scheme, ",", named);
    if (varies) run.name = joined(run.name, "/", named);
    if (varies || !setting.isDefault(own)) run.options = joined(run.options, " ", setting.option() + " " + value);
}

/// Returns the run of `own`. Its name contains the settings that vary in `all`. Its scheme also contains the `given`
/// settings, except the error, which has its own part of the name in files.
BenchRun runOf(
    const settings::Settings& own, const std::vector<settings::Settings>& all, const std::set<std::string>& given) {
    BenchRun run{{}, own, {}};
    run.scheme = settings::named("shadows").text(own);
    for (const settings::Setting& setting : settings::table()) {
        if (!setting.description().isSwept) continue;
        const std::string value = setting.text(own);
        const bool varies = std::any_of(
            all.begin(), all.end(), [&](const settings::Settings& other) { return setting.text(other) != value; });
        if (!settings::appliesTo(setting, own)) continue;
        addToName(run, setting, own, varies, given.contains(setting.column()));
    }
    if (own.quality.cellScheme != plan::Quality().cellScheme) {
        const std::string cells = "cells:" + std::string(wordOf(plan::kCellSchemes, own.quality.cellScheme));
        run.name = joined(run.name, "/", cells);
        run.scheme = joined(run.scheme, ",", cells);
    }
    run.options = joined(run.options, " ", settings::optionsToPaste(own, false));
    if (run.name.empty()) run.name = "run";
    return run;
}

/// Returns true if `a` and `b` draw the same exact shadows. They can differ in settings of shadow maps.
bool areTheSameExact(const settings::Settings& a, const settings::Settings& b) {
    if (a.quality.shadows != plan::ShadowMode::Exact || b.quality.shadows != plan::ShadowMode::Exact) return false;
    if (a.quality.cellScheme != b.quality.cellScheme) return false;
    const auto table = settings::table();
    return std::all_of(table.begin(), table.end(), [&](const settings::Setting& setting) {
        return !settings::appliesTo(setting, a) || setting.text(a) == setting.text(b);
    });
}

/// Returns a function that converts each frame's picture to PNG and calls `options.onPicture` with it.
Walk::OnFrame tellerOf(std::size_t run, const WalkOptions& options) {
    return [run, &options](int frame, const render::Picture& picture) {
        options.onPicture(run, frame, render::pngBytes(picture));
    };
}

/// Walks all `runs` in each repetition before the next repetition begins, and returns their results.
std::vector<RunResult> walked(
    const BenchWalks& walks, std::span<const BenchRun> runs, const WalkOptions& options, Progress& progress) {
    std::vector<RunResult> results(runs.size());
    for (std::size_t run = 0; run < runs.size(); ++run)
        results[run].run = runs[run];
    for (int repetition = 0; repetition < options.repetitions; ++repetition)
        for (std::size_t run = 0; run < runs.size(); ++run) {
            const bool isTold = options.onPicture && repetition == 0;
            Walk walk(walks.session, walks.path, options, results[run]);
            walk.repeat(repetition, isTold ? tellerOf(run, options) : Walk::OnFrame(), progress);
        }
    return results;
}

} // namespace

std::vector<BenchRun> runsOf(const std::vector<settings::Settings>& settings, const std::set<std::string>& given) {
    std::vector<BenchRun> runs;
    runs.reserve(settings.size());
    for (const settings::Settings& each : settings) {
        const auto isThere = [&](const BenchRun& run) { return areTheSameExact(run.settings, each); };
        if (std::none_of(runs.begin(), runs.end(), isThere)) runs.push_back(runOf(each, settings, given));
    }
    return runs;
}

settings::Settings backendSettings(const std::vector<BenchRun>& runs) {
    const auto isNeedy = [](const BenchRun& run) { return settings::softwareNeed(run.settings).has_value(); };
    const auto needy = std::find_if(runs.begin(), runs.end(), isNeedy);
    return needy != runs.end() ? needy->settings : runs.front().settings;
}

std::vector<RunResult> walkAll(const BenchWalks& walks, Progress& progress) {
    std::vector<RunResult> results = walked(walks, walks.runs, walks.options, progress);
    if (walks.options.groundTruth != validation::GroundTruth::None)
        for (RunResult& result : results)
            Walk(walks.session, walks.path, walks.options, result).validate(progress);
    return results;
}

RunResult walkAgain(const BenchWalks& walks, std::size_t run, Progress& progress) {
    WalkOptions silent = walks.options;
    silent.onPicture = {};
    return walked(walks, std::span(&walks.runs[run], 1), silent, progress).front();
}

std::size_t frameCount(const std::vector<BenchRun>& runs, const WalkOptions& options) {
    const int walks = options.repetitions + (options.groundTruth == validation::GroundTruth::None ? 0 : 1);
    return runs.size() * static_cast<std::size_t>(options.frames) * static_cast<std::size_t>(walks);
}

int quickFrames(
    task::Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options) {
    RunResult look;
    look.run = runs.front();
    WalkOptions ends = options;
    ends.frames = 3; // at the start, the middle and the end of the path
    Walk walk(session, path, ends, look);
    const double work = std::max({walk.drawnWork(0), walk.drawnWork(1), walk.drawnWork(2)});
    const double walks = static_cast<double>(runs.size()) * options.repetitions;
    return static_cast<int>(std::clamp(kQuickWork / (walks * work), 1.0, static_cast<double>(options.frames)));
}

std::vector<report::Picture> middlePictures(
    task::Session& session,
    const path::CameraPath& path,
    const BenchRun& run,
    const WalkOptions& options,
    Progress& progress) {
    RunResult asked;
    asked.run = run;
    Walk walk(session, path, options, asked);
    RunResult traced = asked;
    traced.run.settings.quality.shadows = plan::ShadowMode::Rays;
    const auto draw = [&](Walk& drawn, render::Overlay overlay = render::Overlay::None) {
        return drawn.picture(overlay, progress);
    };
    Walk tracing(session, path, options, traced);
    const render::Picture picture = draw(walk);
    const render::Picture reference = draw(tracing);
    return {
        {run.name, "picture", render::pngBytes(picture)},
        {run.name, "reference", render::pngBytes(reference)},
        {run.name, "difference", render::pngBytes(magnifiedDifference(picture, reference))},
        {run.name, "texels", render::pngBytes(draw(walk, render::Overlay::Texels))},
        {run.name, "aliasing", render::pngBytes(draw(walk, render::Overlay::Aliasing))},
        {run.name, "partitions", render::pngBytes(draw(walk, render::Overlay::Partitions))}};
}

std::vector<report::Picture> middlePicturesOfAll(
    const BenchWalks& walks, const std::vector<std::size_t>& which, Progress& progress) {
    std::vector<std::size_t> distinct; // one run per group of runs with identical pictures
    const auto drawnFor = [&](std::size_t run) {
        return std::find_if(distinct.begin(), distinct.end(), [&](std::size_t before) {
            return settings::drawAlike(walks.runs[before].settings, walks.runs[run].settings);
        });
    };
    for (const std::size_t run : which)
        if (drawnFor(run) == distinct.end()) distinct.push_back(run);
    std::vector<std::vector<report::Picture>> drawn(walks.runs.size());
    for (const std::size_t run : distinct)
        drawn[run] = middlePictures(walks.session, walks.path, walks.runs[run], walks.options, progress);
    progress.advance(kFramesOfPictures * (which.size() - distinct.size()));
    std::vector<report::Picture> pictures;
    for (const std::size_t run : which)
        for (report::Picture picture : drawn[*drawnFor(run)]) {
            picture.run = walks.runs[run].name;
            pictures.push_back(std::move(picture));
        }
    return pictures;
}

} // namespace gnomon::bench
