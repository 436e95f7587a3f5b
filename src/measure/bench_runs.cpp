#include "measure/bench_runs.h"

#include "measure/bytes/row_bytes.h"
#include "settings/backend_needs.h"
#include "settings/resolve.h"
#include "settings/table.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

namespace gnomon::measure {

namespace {

/// Four times the absolute difference of each channel.
executor::Picture magnifiedDifference(const executor::Picture& a, const executor::Picture& b) {
    executor::Picture result = a;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const int difference = std::abs(a.pixels[i][channel] - b.pixels[i][channel]);
            result.pixels[i][channel] = static_cast<std::uint8_t>(std::min(255, 4 * difference));
        }
    return result;
}

/// `text` with `more` behind it, and `separator` between them if both are there.
std::string joined(std::string text, const char* separator, const std::string& more) {
    if (!text.empty() && !more.empty()) text += separator;
    return text + more;
}

/// The run of `own`, named by what varies among `all`.
BenchRun runOf(const settings::Settings& own, const std::vector<settings::Settings>& all) {
    BenchRun run{{}, own, {}};
    for (const settings::Setting& setting : settings::table()) {
        if (!setting.description().isSwept) continue;
        const std::string value = setting.text(own);
        const bool varies = std::any_of(
            all.begin(), all.end(), [&](const settings::Settings& other) { return setting.text(other) != value; });
        if (!settings::appliesTo(setting, own)) continue;
        if (varies) run.name = joined(run.name, "/", setting.column() + ":" + value);
        if (varies || !setting.isDefault(own)) run.options = joined(run.options, " ", setting.option() + " " + value);
    }
    if (own.quality.cellScheme != plan::Quality().cellScheme)
        run.name = joined(run.name, "/", "cells:" + std::string(wordOf(plan::kCellSchemes, own.quality.cellScheme)));
    run.options = joined(run.options, " ", settings::optionsToPaste(own, false));
    if (run.name.empty()) run.name = "run";
    return run;
}

/// Whether `a` and `b` draw exact shadows alike: they differ at most in how shadow maps would be.
bool areTheSameExact(const settings::Settings& a, const settings::Settings& b) {
    if (a.quality.shadows != plan::ShadowMode::Exact || b.quality.shadows != plan::ShadowMode::Exact) return false;
    if (a.quality.cellScheme != b.quality.cellScheme) return false;
    const auto table = settings::table();
    return std::all_of(table.begin(), table.end(), [&](const settings::Setting& setting) {
        return !settings::appliesTo(setting, a) || setting.text(a) == setting.text(b);
    });
}

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

/// What processes do for each other.
enum class WalkKind : std::uint8_t {
    Walk,      // one repetition
    WalkAgain, // likewise, of whose pictures nobody is told
    Prove,     // the first repetition
    Pictures,  // of the middle frame
};

struct WalkTask {
    WalkKind kind = WalkKind::Walk;
    std::size_t run = 0;
    int repetition = 0;
    std::vector<telemetry::FrameRow> rows = {}; // to be proven
};

TaskBytes encoded(const WalkTask& task) {
    ByteWriter out;
    out.put(static_cast<std::uint8_t>(task.kind));
    out.putVarint(task.run);
    out.putVarint(static_cast<std::uint64_t>(task.repetition));
    putRows(out, task.rows);
    return out.take();
}

WalkTask decodedTask(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    WalkTask task;
    task.kind = static_cast<WalkKind>(in.take<std::uint8_t>());
    task.run = in.takeVarint();
    task.repetition = static_cast<int>(in.takeVarint());
    task.rows = takeRows(in);
    in.expectEnd();
    return task;
}

/// What came of a walk.
TaskBytes encoded(const RunResult& result) {
    ByteWriter out;
    out.put(result.cpuMs);
    out.put(result.firstFrameMs);
    putRows(out, result.rows);
    return out.take();
}

/// Adds it to `result`, in whose rows it comes last.
void addWalk(std::span<const std::byte> bytes, RunResult& result) {
    ByteReader in(bytes);
    result.cpuMs += in.take<double>();
    const auto firstFrameMs = in.take<double>();
    if (result.firstFrameMs == 0) result.firstFrameMs = firstFrameMs;
    std::vector<telemetry::FrameRow> rows = takeRows(in);
    std::move(rows.begin(), rows.end(), std::back_inserter(result.rows));
}

TaskBytes encoded(const std::vector<report::Picture>& pictures) {
    ByteWriter out;
    for (const report::Picture& picture : pictures) {
        out.putText(picture.kind);
        out.putVarint(picture.png.size());
        out.put(std::as_bytes(std::span(picture.png)));
    }
    return out.take();
}

std::vector<std::uint8_t> takePng(ByteReader& in, std::size_t bytes) {
    const std::span<const std::byte> taken = in.take(bytes);
    std::vector<std::uint8_t> png(taken.size());
    std::transform(taken.begin(), taken.end(), png.begin(), [](std::byte b) { return static_cast<std::uint8_t>(b); });
    return png;
}

std::vector<report::Picture> decodedPictures(std::span<const std::byte> bytes, const std::string& run) {
    ByteReader in(bytes);
    std::vector<report::Picture> pictures;
    while (in.remaining() > 0) {
        std::string kind = in.takeText();
        pictures.push_back({run, std::move(kind), takePng(in, in.takeVarint())});
    }
    return pictures;
}

/// Tells the leading process of the pictures of a run.
Walk::OnFrame tellerOf(std::size_t run, const FarmWork::Tell& tell) {
    return [run, &tell](int frame, const executor::Picture& picture) {
        const std::vector<std::uint8_t> png = executor::pngBytes(picture);
        ByteWriter out;
        out.putVarint(run);
        out.putVarint(static_cast<std::uint64_t>(frame));
        out.put(std::as_bytes(std::span(png)));
        tell(out.take());
    };
}

void hearPicture(const WalkOptions& options, std::span<const std::byte> told) {
    ByteReader in(told);
    const std::size_t run = in.takeVarint();
    const auto frame = static_cast<int>(in.takeVarint());
    options.onPicture(run, frame, takePng(in, in.remaining()));
}

TaskBytes perform(const BenchWalks& walks, const WalkTask& task, Progress& progress, const FarmWork::Tell& tell) {
    RunResult result;
    result.run = walks.runs.at(task.run);
    result.rows = task.rows;
    if (task.kind == WalkKind::Pictures)
        return encoded(middlePictures(walks.session, walks.path, result.run, walks.options, progress));
    Walk walk(walks.session, walks.path, walks.options, result);
    const bool isTold = task.kind == WalkKind::Walk && walks.options.onPicture && task.repetition == 0;
    if (task.kind == WalkKind::Prove)
        walk.prove(progress);
    else
        walk.repeat(task.repetition, isTold ? tellerOf(task.run, tell) : Walk::OnFrame(), progress);
    return encoded(result);
}

/// Walks runs `which`, each repetition all of them before the next one.
std::vector<RunResult> walked(
    const BenchWalks& walks, const std::vector<std::size_t>& which, WalkKind kind, Progress& progress) {
    const auto repetitions = static_cast<std::size_t>(walks.options.repetitions);
    std::vector<TaskBytes> taken(which.size() * repetitions);
    FarmTasks tasks;
    tasks.name = kind == WalkKind::Walk ? "bench" : "once more";
    tasks.count = taken.size();
    tasks.input = [&](std::size_t task) {
        return encoded(WalkTask{kind, which[task % which.size()], static_cast<int>(task / which.size())});
    };
    tasks.take = [&](std::size_t task, std::span<const std::byte> bytes) {
        taken[task].assign(bytes.begin(), bytes.end());
    };
    tasks.hear = [&](std::span<const std::byte> told) { hearPicture(walks.options, told); };
    walks.farm.run(tasks, workOf(walks), progress);
    std::vector<RunResult> results(which.size());
    for (std::size_t task = 0; task < taken.size(); ++task) {
        RunResult& result = results[task % which.size()];
        result.run = walks.runs[which[task % which.size()]];
        addWalk(taken[task], result);
    }
    return results;
}

/// Fills the columns of accuracy of each first repetition.
void prove(const BenchWalks& walks, std::vector<RunResult>& results, Progress& progress) {
    const auto frames = static_cast<std::ptrdiff_t>(walks.options.frames);
    FarmTasks tasks;
    tasks.name = "proof";
    tasks.count = results.size();
    tasks.input = [&](std::size_t run) {
        const auto begin = results[run].rows.begin();
        return encoded(WalkTask{WalkKind::Prove, run, 0, {begin, begin + frames}});
    };
    tasks.take = [&](std::size_t run, std::span<const std::byte> bytes) {
        RunResult proven;
        addWalk(bytes, proven);
        std::move(proven.rows.begin(), proven.rows.end(), results[run].rows.begin());
    };
    walks.farm.run(tasks, workOf(walks), progress);
}

/// The numbers of all runs.
std::vector<std::size_t> allOf(const std::vector<BenchRun>& runs) {
    std::vector<std::size_t> all(runs.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

} // namespace

std::vector<BenchRun> runsOf(const std::vector<settings::Settings>& settings) {
    std::vector<BenchRun> runs;
    runs.reserve(settings.size());
    for (const settings::Settings& each : settings) {
        const auto isThere = [&](const BenchRun& run) { return areTheSameExact(run.settings, each); };
        if (std::none_of(runs.begin(), runs.end(), isThere)) runs.push_back(runOf(each, settings));
    }
    return runs;
}

settings::Settings executorSettings(const std::vector<BenchRun>& runs) {
    const auto isNeedy = [](const BenchRun& run) { return settings::needsSoftware(run.settings); };
    const auto needy = std::find_if(runs.begin(), runs.end(), isNeedy);
    return needy != runs.end() ? needy->settings : runs.front().settings;
}

std::string keyOf(const BenchWalks& walks) {
    const WalkOptions& options = walks.options;
    std::string key = "model " + walks.session.model().contentHash() + "; path " + path::contentHash(walks.path);
    for (const int number :
         {options.frames,
          options.repetitions,
          options.warmup,
          options.isRealTime ? 1 : 0,
          static_cast<int>(options.oracle),
          options.provenFrames,
          options.countsWrongPixels ? 1 : 0})
        key += "; " + std::to_string(number);
    for (const BenchRun& run : walks.runs)
        key += "; " + run.name + " " + run.options;
    return key;
}

FarmWork workOf(const BenchWalks& walks) {
    return {
        [walks](std::span<const std::byte> input, Progress& progress, const FarmWork::Tell& tell) {
            return perform(walks, decodedTask(input), progress, tell);
        },
        FarmWork::Thread::Calling};
}

std::vector<RunResult> walkAll(const BenchWalks& walks, Progress& progress) {
    std::vector<RunResult> results = walked(walks, allOf(walks.runs), WalkKind::Walk, progress);
    if (walks.options.oracle != proof::Oracle::None) prove(walks, results, progress);
    return results;
}

RunResult walkAgain(const BenchWalks& walks, std::size_t run, Progress& progress) {
    return walked(walks, {run}, WalkKind::WalkAgain, progress).front();
}

std::size_t frameCount(const std::vector<BenchRun>& runs, const WalkOptions& options) {
    const int walks = options.repetitions + (options.oracle == proof::Oracle::None ? 0 : 1);
    return runs.size() * static_cast<std::size_t>(options.frames) * static_cast<std::size_t>(walks);
}

int quickFrames(
    Session& session, const path::CameraPath& path, const std::vector<BenchRun>& runs, const WalkOptions& options) {
    RunResult look;
    look.run = runs.front();
    WalkOptions ends = options;
    ends.frames = 3; // first, middle and last
    Walk walk(session, path, ends, look);
    const double work = std::max({walk.work(0), walk.work(1), walk.work(2)});
    const double walks = static_cast<double>(runs.size()) * options.repetitions;
    return static_cast<int>(std::clamp(kQuickWork / (walks * work), 1.0, static_cast<double>(options.frames)));
}

std::vector<report::Picture> middlePictures(
    Session& session,
    const path::CameraPath& path,
    const BenchRun& run,
    const WalkOptions& options,
    Progress& progress) {
    RunResult asked;
    asked.run = run;
    Walk walk(session, path, options, asked);
    RunResult traced = asked;
    traced.run.settings.quality.shadows = plan::ShadowMode::Rays;
    const auto draw = [&](Walk& drawn, executor::Overlay overlay = executor::Overlay::None) {
        return drawn.picture(overlay, progress);
    };
    Walk tracing(session, path, options, traced);
    const executor::Picture picture = draw(walk);
    const executor::Picture reference = draw(tracing);
    return {
        {run.name, "picture", executor::pngBytes(picture)},
        {run.name, "reference", executor::pngBytes(reference)},
        {run.name, "difference", executor::pngBytes(magnifiedDifference(picture, reference))},
        {run.name, "texels", executor::pngBytes(draw(walk, executor::Overlay::Texels))},
        {run.name, "aliasing", executor::pngBytes(draw(walk, executor::Overlay::Aliasing))},
        {run.name, "partitions", executor::pngBytes(draw(walk, executor::Overlay::Partitions))}};
}

void middlePicturesOfEach(
    const BenchWalks& walks, const std::vector<std::size_t>& which, const TakePictures& take, Progress& progress) {
    FarmTasks tasks;
    tasks.name = "pictures";
    tasks.count = which.size();
    tasks.input = [&](std::size_t task) { return encoded(WalkTask{WalkKind::Pictures, which[task]}); };
    tasks.take = [&](std::size_t task, std::span<const std::byte> bytes) {
        take(which[task], decodedPictures(bytes, walks.runs[which[task]].name));
    };
    walks.farm.run(tasks, workOf(walks), progress);
}

std::vector<report::Picture> middlePicturesOfAll(
    const BenchWalks& walks, const std::vector<std::size_t>& which, Progress& progress) {
    std::vector<std::size_t> distinct; // a run for all that draw alike
    const auto drawnFor = [&](std::size_t run) {
        return std::find_if(distinct.begin(), distinct.end(), [&](std::size_t before) {
            return settings::drawAlike(walks.runs[before].settings, walks.runs[run].settings);
        });
    };
    for (const std::size_t run : which)
        if (drawnFor(run) == distinct.end()) distinct.push_back(run);
    std::vector<std::vector<report::Picture>> drawn(walks.runs.size());
    middlePicturesOfEach(
        walks,
        distinct,
        [&](std::size_t run, std::vector<report::Picture> pictures) { drawn[run] = std::move(pictures); },
        progress);
    progress.advance(kFramesOfPictures * (which.size() - distinct.size()));
    std::vector<report::Picture> pictures;
    for (const std::size_t run : which)
        for (report::Picture picture : drawn[*drawnFor(run)]) {
            picture.run = walks.runs[run].name;
            pictures.push_back(std::move(picture));
        }
    return pictures;
}

} // namespace gnomon::measure
