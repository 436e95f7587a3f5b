#include "measure/bench_runs.h"

#include "settings/option_text.h"
#include "telemetry/benchmark_report.h"
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

double median(const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    std::vector<double> values;
    for (const telemetry::FrameRow& row : rows)
        if (row.*column) values.push_back(*(row.*column));
    return values.empty() ? 0 : telemetry::quantile(values, 0.5);
}

double mean(const std::vector<telemetry::FrameRow>& rows, std::optional<std::int64_t> telemetry::FrameRow::*column) {
    double sum = 0;
    for (const telemetry::FrameRow& row : rows)
        sum += static_cast<double>((row.*column).value_or(0));
    return rows.empty() ? 0 : sum / static_cast<double>(rows.size());
}

std::optional<double> mean(
    const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    double sum = 0;
    int count = 0;
    for (const telemetry::FrameRow& row : rows) {
        if (!(row.*column)) continue;
        sum += *(row.*column);
        ++count;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> largest(
    const std::vector<telemetry::FrameRow>& rows, std::optional<double> telemetry::FrameRow::*column) {
    std::optional<double> result;
    for (const telemetry::FrameRow& row : rows)
        if (row.*column) result = std::max(result.value_or(*(row.*column)), *(row.*column));
    return result;
}

/// The median over repetitions of every frame's time, in the order of the path.
std::vector<double> timesAlongPath(const std::vector<telemetry::FrameRow>& rows) {
    std::map<std::int64_t, std::vector<double>> times;
    for (const telemetry::FrameRow& row : rows)
        times[row.frame].push_back(row.totalMs.value_or(0));
    std::vector<double> result;
    result.reserve(times.size());
    for (const auto& [frame, values] : times)
        result.push_back(telemetry::quantile(values, 0.5));
    return result;
}

/// Half the range of the repetitions' medians over their middle; nothing if there is only one repetition.
std::optional<double> noise(const std::vector<telemetry::FrameRow>& rows) {
    std::map<std::int64_t, std::vector<double>> times;
    for (const telemetry::FrameRow& row : rows)
        times[row.repetition].push_back(row.totalMs.value_or(0));
    if (times.size() < 2) return std::nullopt;
    std::vector<double> medians;
    medians.reserve(times.size());
    for (const auto& [repetition, values] : times)
        medians.push_back(telemetry::quantile(values, 0.5));
    const auto [least, largest] = std::minmax_element(medians.begin(), medians.end());
    return *least + *largest > 0 ? (*largest - *least) / (*largest + *least) : 0;
}

/// One run's walk along the path.
class Walk {
public:
    Walk(
        Session& session,
        const settings::ViewOptions& viewOptions,
        const path::CameraPath& path,
        const WalkOptions& options,
        RunResult& result)
        : session_(session),
          path_(path),
          options_(options),
          result_(result),
          view_(settings::viewOf(viewOptions, session.model().summary())),
          quality_(settings::qualityOf(viewOptions, result.run.settings)) {
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
            telemetry::FrameRow row = draw(frame);
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
        for (int frame = 0; frame < options_.frames; ++frame) {
            const bool isProven = isProvenFrame(frame);
            frameOptions_.measuresAliasing = frameOptions_.measuresCrawl = frameOptions_.comparesWithFinest = isProven;
            frameOptions_.oracle = isProven ? options_.oracle : frame::Oracle::None;
            const telemetry::FrameRow proof = draw(frame);
            telemetry::FrameRow& row = result_.rows[static_cast<std::size_t>(frame)];
            row.measuredAliasing = proof.measuredAliasing;
            row.wrongShadowFraction = proof.wrongShadowFraction;
            row.shadowEdgeP99Px = proof.shadowEdgeP99Px;
            row.missedShadowFraction = proof.missedShadowFraction;
            row.unexplainedShadowFraction = proof.unexplainedShadowFraction;
            row.imageDifference = proof.imageDifference;
            row.crawl = proof.crawl;
            progress.advance(1);
        }
    }

    /// The middle frame.
    executor::Picture picture(executor::Overlay overlay, Progress& progress) {
        frameOptions_.overlay = overlay;
        session_.renderer().forget();
        draw(options_.frames / 2);
        progress.advance(1);
        return session_.executor().picture();
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

    telemetry::FrameRow draw(int frame) {
        view_.camera = path::cameraAt(path_, timeOf(frame));
        telemetry::FrameRow row = session_.renderer().render(view_, quality_, frameOptions_).row;
        row.sinceStartMs = telemetry::sinceProcessStart().count;
        if (result_.firstFrameMs == 0) result_.firstFrameMs = *row.sinceStartMs;
        return row;
    }

    Session& session_;
    const path::CameraPath& path_;
    const WalkOptions& options_;
    RunResult& result_;
    plan::View view_;
    plan::Quality quality_;
    frame::FrameOptions frameOptions_;
};

} // namespace

std::vector<BenchRun> named(const std::vector<settings::SweptSettings>& settings) {
    std::vector<BenchRun> runs;
    runs.reserve(settings.size());
    const settings::SweptSettings defaults;
    for (const settings::SweptSettings& each : settings) {
        BenchRun run{{}, each, {}};
        for (const settings::SweptOption& option : settings::sweptOptions()) {
            const std::string& value = each.*option.value;
            const bool varies = std::any_of(
                settings.begin(), settings.end(), [&](const auto& other) { return other.*option.value != value; });
            if (varies) run.name += (run.name.empty() ? "" : "/") + settings::columnName(option.flag) + ":" + value;
            if (varies || value != defaults.*option.value)
                run.options += (run.options.empty() ? "" : " ") + std::string(option.flag) + " " + value;
        }
        if (run.name.empty()) run.name = "run";
        runs.push_back(run);
    }
    return runs;
}

std::vector<BenchRun> combinations(const settings::SweptSettings& lists, const std::optional<std::string>& shadowMaps) {
    if (shadowMaps && lists.facePartitions != "off")
        throw settings::UsageError{
            "--shadow-maps turns faces off, so --face-partitions " + lists.facePartitions + " contradicts it"};
    std::vector<settings::SweptSettings> all(1);
    for (const settings::SweptOption& option : settings::sweptOptions()) {
        const bool isMaps = shadowMaps && option.value == &settings::SweptSettings::zPartitions;
        const std::vector<std::string> values = isMaps ? settings::parseList("--shadow-maps", *shadowMaps)
                                                       : settings::parseList(option.flag, lists.*option.value);
        if (isMaps)
            for (const std::string& value : values)
                if (value != "auto") settings::parseWhole("--shadow-maps", value, 1, settings::kMaxSlices);
        std::vector<settings::SweptSettings> extended;
        for (const settings::SweptSettings& settings : all)
            for (const std::string& value : values) {
                extended.push_back(settings);
                extended.back().*option.value = value;
            }
        all = extended;
    }
    return named(all);
}

std::vector<RunResult> walkAll(
    Session& session,
    const settings::ViewOptions& view,
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
            Walk walk(session, view, path, options, result);
            walk.repeat(repetition, progress);
        }
    if (options.oracle != frame::Oracle::None)
        for (RunResult& result : results)
            Walk(session, view, path, options, result).prove(progress);
    return results;
}

std::size_t frameCount(const std::vector<BenchRun>& runs, const WalkOptions& options) {
    const int walks = options.repetitions + (options.oracle == frame::Oracle::None ? 0 : 1);
    return runs.size() * static_cast<std::size_t>(options.frames) * static_cast<std::size_t>(walks);
}

std::vector<report::Picture> middlePictures(
    Session& session,
    const settings::ViewOptions& view,
    const path::CameraPath& path,
    const BenchRun& run,
    const WalkOptions& options,
    Progress& progress) {
    RunResult asked;
    asked.run = run;
    Walk walk(session, view, path, options, asked);
    RunResult traced = asked;
    traced.run.settings.shadows = "rays";
    const auto draw = [&](Walk& drawn, executor::Overlay overlay = executor::Overlay::None) {
        return drawn.picture(overlay, progress);
    };
    Walk tracing(session, view, path, options, traced);
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

report::RunSummary summary(const RunResult& result) {
    using telemetry::FrameRow;
    const auto& rows = result.rows;
    report::RunSummary s;
    s.name = result.run.name;
    s.options = result.run.options;
    for (const settings::SweptOption& option : settings::sweptOptions())
        s.settings[settings::columnName(option.flag)] = result.run.settings.*option.value;
    std::vector<double> totals;
    double promised = 0;
    for (const FrameRow& row : rows) {
        totals.push_back(row.totalMs.value_or(0));
        promised = std::max({promised, row.promisedAliasingX.value_or(0), row.promisedAliasingZ.value_or(0)});
        s.shadowMaps = std::max(s.shadowMaps, static_cast<int>(row.shadowMaps));
        s.storageFactor = std::max(s.storageFactor, row.storageFactor.value_or(0));
        s.promiseKept = s.promiseKept && row.promiseKept.value_or(true);
        s.pagesDamaged = std::max(s.pagesDamaged, static_cast<std::uint64_t>(row.pagesDamaged.value_or(0)));
        s.pagesMissing = std::max(s.pagesMissing, static_cast<std::uint64_t>(row.pagesMissing.value_or(0)));
    }
    s.p50Ms = telemetry::quantile(totals, 0.50);
    s.p95Ms = telemetry::quantile(totals, 0.95);
    s.p99Ms = telemetry::quantile(totals, 0.99);
    s.noise = noise(rows);
    s.stages = {
        median(rows, &FrameRow::planMs),
        median(rows, &FrameRow::selectMs),
        median(rows, &FrameRow::cullMs),
        median(rows, &FrameRow::streamMs),
        median(rows, &FrameRow::shadowMs),
        median(rows, &FrameRow::imageMs)};
    s.imageTriangles = mean(rows, &FrameRow::imageTriangles);
    s.shadowTriangles = mean(rows, &FrameRow::shadowTriangles);
    if (promised > 0) s.errors[report::ErrorKind::PromisedAliasing] = promised;
    const auto addError = [&](report::ErrorKind kind, std::optional<double> value) {
        if (value) s.errors[kind] = *value;
    };
    addError(report::ErrorKind::MeasuredAliasing, largest(rows, &FrameRow::measuredAliasing));
    // A coarser map is excused from more thin casters: only with those do maps of different texels compare.
    if (const auto wrong = mean(rows, &FrameRow::wrongShadowFraction))
        s.errors[report::ErrorKind::WrongShadow] = *wrong + mean(rows, &FrameRow::missedShadowFraction).value_or(0);
    // A frame with hardly an edge in it puts a lone one as far away as the picture is wide.
    if (mean(rows, &FrameRow::shadowEdgeP99Px))
        s.errors[report::ErrorKind::ShadowEdge] = median(rows, &FrameRow::shadowEdgeP99Px);
    addError(report::ErrorKind::ImageDifference, mean(rows, &FrameRow::imageDifference));
    s.crawl = mean(rows, &FrameRow::crawl).value_or(-1);
    s.frameMs = timesAlongPath(rows);
    return s;
}

} // namespace gnomon::measure
