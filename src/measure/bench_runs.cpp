#include "measure/bench_runs.h"

#include "executor/overlay/legend.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "telemetry/process_clock.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
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

/// One run's walk along the path.
class Walk {
public:
    Walk(Session& session, const path::CameraPath& path, const WalkOptions& options, RunResult& result)
        : session_(session),
          path_(path),
          options_(options),
          result_(result),
          view_(settings::viewOf(settings::uprightIn(result.run.settings, session.model()), session.model().summary())),
          quality_(settings::qualityOf(result.run.settings)) {
        frameOptions_.waiting = options.isRealTime ? frame::Waiting::Never : frame::Waiting::UntilComplete;
    }

    /// Warm-up, then a row a frame.
    void repeat(int repetition, Progress& progress) {
        warmUp(progress);
        const auto start = std::chrono::steady_clock::now();
        for (int frame = 0; frame < options_.frames; ++frame) {
            if (options_.isRealTime)
                std::this_thread::sleep_until(start + std::chrono::duration<double>(timeOf(frame) - timeOf(0)));
            const double cpuBefore = telemetry::processorTime().count;
            telemetry::FrameRow row = draw(frame).row;
            result_.cpuMs += (telemetry::processorTime().count - cpuBefore) / (options_.frames * options_.repetitions);
            row.run = result_.run.name;
            row.repetition = repetition;
            row.frame = frame;
            row.timeS = timeOf(frame);
            result_.rows.push_back(row);
            if (options_.onPicture && repetition == 0)
                options_.onPicture(result_.run, frame, session_.executor().picture());
            progress.advance(1);
        }
    }

    /// Walks the first repetition once more, untimed and with the same plans, and holds some of its frames against
    /// the oracle.
    void prove(Progress& progress) {
        warmUp(progress);
        proof::ProofOptions options;
        options.measuresAliasing = options.measuresCrawl = options.comparesWithFinest = true;
        options.oracle = options_.oracle;
        options.countsWrongPixels = options_.countsWrongPixels;
        for (int frame = 0; frame < options_.frames; ++frame) {
            const frame::Frame drawn = draw(frame);
            if (isProvenFrame(frame))
                proof::setAccuracy(
                    proof::prove(session_.renderer(), drawn, options), result_.rows[static_cast<std::size_t>(frame)]);
            progress.advance(1);
        }
    }

    /// What drawing `frame` works through: triangles, and twice its pixels, each of which costs about two of them.
    double work(int frame) {
        const telemetry::FrameRow row = draw(frame).row;
        session_.renderer().forget();
        const std::int64_t pixels = std::int64_t{view_.width} * view_.height;
        return static_cast<double>(row.imageTriangles.value_or(0) + row.shadowTriangles.value_or(0) + 2 * pixels);
    }

    /// The middle frame, with its legend.
    executor::Picture picture(executor::Overlay overlay, Progress& progress) {
        frameOptions_.overlay = overlay;
        session_.renderer().forget();
        const frame::Frame drawn = draw(options_.frames / 2);
        if (overlay == executor::Overlay::None)
            quality_.shadows = drawn.plan.quality.shadows; // for the overlays after it
        progress.advance(1);
        executor::Picture picture = session_.executor().picture();
        executor::drawLegend(picture, executor::legendOf(overlay, drawn.plan));
        return picture;
    }

private:
    void warmUp(Progress& progress) {
        session_.renderer().forget();
        for (int i = 0; i < options_.warmup; ++i) {
            draw(0);
            progress.advance(0); // not counted, but a place to stop
        }
        session_.renderer().forget();
    }

    /// Frames evenly over the path, first and last among them.
    bool isProvenFrame(int frame) const {
        const int last = std::min(options_.provenFrames, options_.frames) - 1;
        for (int i = 0; i <= last; ++i)
            if (frame == (last == 0 ? options_.frames / 2 : i * (options_.frames - 1) / last)) return true;
        return false;
    }

    double timeOf(int frame) const { return path::frameTime(path_, frame, options_.frames); }

    frame::Frame draw(int frame) {
        view_.camera = path::cameraAt(path_, timeOf(frame));
        frame::Frame drawn = session_.renderer().render(view_, quality_, frameOptions_);
        drawn.row.sinceStartMs = telemetry::sinceProcessStart().count;
        if (result_.firstFrameMs == 0) result_.firstFrameMs = *drawn.row.sinceStartMs;
        return drawn;
    }

    Session& session_;
    const path::CameraPath& path_;
    const WalkOptions& options_;
    RunResult& result_;
    plan::View view_;
    plan::Quality quality_;
    frame::FrameOptions frameOptions_;
};

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

std::vector<RunResult> walkAll(
    Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options,
    Progress& progress) {
    std::vector<RunResult> results;
    results.reserve(runs.size());
    for (const BenchRun& run : runs)
        results.emplace_back().run = run;
    for (int repetition = 0; repetition < options.repetitions; ++repetition)
        for (RunResult& result : results) {
            Walk walk(session, path, options, result);
            walk.repeat(repetition, progress);
        }
    if (options.oracle != proof::Oracle::None)
        for (RunResult& result : results)
            Walk(session, path, options, result).prove(progress);
    return results;
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

std::vector<report::Picture> middlePicturesOfAll(
    Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options,
    Progress& progress) {
    std::vector<std::vector<report::Picture>> all;
    for (const BenchRun& run : runs) {
        const auto drawn = std::find_if(
            runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(all.size()), [&](const BenchRun& before) {
                return settings::drawAlike(before.settings, run.settings);
            });
        const auto place = static_cast<std::size_t>(drawn - runs.begin());
        if (place == all.size()) {
            all.push_back(middlePictures(session, path, run, options, progress));
            continue;
        }
        all.push_back(all[place]);
        for (report::Picture& picture : all.back())
            picture.run = run.name;
        progress.advance(kFramesOfPictures);
    }
    std::vector<report::Picture> pictures;
    for (std::vector<report::Picture>& own : all)
        std::move(own.begin(), own.end(), std::back_inserter(pictures));
    return pictures;
}

} // namespace gnomon::measure
