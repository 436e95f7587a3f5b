#include "app/bench_runs.h"

#include "app/option_text.h"
#include "core/file.h"
#include "telemetry/benchmark_report.h"
#include "telemetry/process_clock.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>
#include <utility>

#include <unistd.h>

namespace gnomon::app {

namespace {

/// `--z-partitions` as the name of its column.
std::string columnName(const std::string& flag) {
    std::string name = flag.substr(flag.find_first_not_of('-'));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::vector<std::uint8_t> pngOf(const render::Picture& picture) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("gnomon_bench_" + std::to_string(::getpid()) + ".png")).string();
    render::writePng(path, picture);
    const std::string bytes = readTextFile(path);
    std::filesystem::remove(path);
    return {bytes.begin(), bytes.end()};
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
        const ViewOptions& viewOptions,
        const CameraPath& path,
        const WalkOptions& options,
        RunResult& result)
        : session_(session),
          path_(path),
          options_(options),
          result_(result),
          view_(viewOf(viewOptions, session.model().summary())),
          quality_(qualityOf(viewOptions, result.run.settings)) {
        frameOptions_.waiting = options.isRealTime ? render::Waiting::Never : render::Waiting::UntilComplete;
    }

    /// Warm-up, then a row a frame.
    void repeat(int repetition, Progress& progress) {
        session_.renderer().forget();
        for (int i = 0; i < options_.warmup; ++i)
            draw(0);
        session_.renderer().forget();
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

    /// Fills in what the oracle says of the frames of the first repetition; nothing of it is timed.
    void prove() {
        render::FrameOptions plain = std::exchange(frameOptions_, {});
        frameOptions_.oracle = options_.oracle;
        frameOptions_.measuresAliasing = frameOptions_.comparesWithFinest = true;
        session_.renderer().forget();
        for (int frame = 0; frame < options_.frames; ++frame) {
            const telemetry::FrameRow proved = draw(frame);
            telemetry::FrameRow& row = result_.rows[static_cast<std::size_t>(frame)];
            row.measuredAliasing = proved.measuredAliasing;
            row.wrongShadowFraction = proved.wrongShadowFraction;
            row.shadowEdgeP99Px = proved.shadowEdgeP99Px;
            row.imageDifference = proved.imageDifference;
            row.missedShadowFraction = proved.missedShadowFraction;
            row.unexplainedShadowFraction = proved.unexplainedShadowFraction;
        }
        frameOptions_ = plain;
    }

    void keepPictures() {
        draw(options_.frames / 2);
        result_.picture = pngOf(session_.executor().picture());
        frameOptions_.overlay = render::Overlay::Partitions;
        draw(options_.frames / 2);
        result_.partitions = pngOf(session_.executor().picture());
    }

private:
    double timeOf(int frame) const { return frameTime(path_, frame, options_.frames); }

    telemetry::FrameRow draw(int frame) {
        view_.camera = cameraAt(path_, timeOf(frame));
        telemetry::FrameRow row = session_.renderer().render(view_, quality_, frameOptions_).row;
        row.sinceStartMs = telemetry::sinceProcessStart().count;
        if (result_.firstFrameMs == 0) result_.firstFrameMs = *row.sinceStartMs;
        return row;
    }

    Session& session_;
    const CameraPath& path_;
    const WalkOptions& options_;
    RunResult& result_;
    plan::View view_;
    plan::Quality quality_;
    render::FrameOptions frameOptions_;
};

} // namespace

std::vector<BenchRun> named(const std::vector<SweptSettings>& settings) {
    std::vector<BenchRun> runs;
    runs.reserve(settings.size());
    const SweptSettings defaults;
    for (const SweptSettings& each : settings) {
        BenchRun run{{}, each, {}};
        for (const SweptOption& option : sweptOptions()) {
            const std::string& value = each.*option.value;
            const bool varies = std::any_of(
                settings.begin(), settings.end(), [&](const auto& other) { return other.*option.value != value; });
            if (varies) run.name += (run.name.empty() ? "" : "/") + columnName(option.flag) + ":" + value;
            if (varies || value != defaults.*option.value)
                run.options += (run.options.empty() ? "" : " ") + std::string(option.flag) + " " + value;
        }
        if (run.name.empty()) run.name = "run";
        runs.push_back(run);
    }
    return runs;
}

std::vector<BenchRun> combinations(const SweptSettings& lists, const std::string& shadowMaps) {
    std::vector<SweptSettings> all(1);
    for (const SweptOption& option : sweptOptions()) {
        const bool isMaps = !shadowMaps.empty() && option.value == &SweptSettings::zPartitions;
        std::vector<SweptSettings> extended;
        for (const SweptSettings& settings : all)
            for (const std::string& value : parseList(isMaps ? shadowMaps : lists.*option.value)) {
                extended.push_back(settings);
                extended.back().*option.value = value;
            }
        all = extended;
    }
    return named(all);
}

std::vector<RunResult> walkAll(
    Session& session,
    const ViewOptions& view,
    const CameraPath& path,
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
            if (repetition + 1 < options.repetitions) continue;
            if (options.oracle != render::Oracle::None) walk.prove();
            if (options.keepsPictures) walk.keepPictures();
        }
    return results;
}

report::RunSummary summary(const RunResult& result) {
    using telemetry::FrameRow;
    const auto& rows = result.rows;
    report::RunSummary s;
    s.name = result.run.name;
    s.options = result.run.options;
    for (const SweptOption& option : sweptOptions())
        s.settings[columnName(option.flag)] = result.run.settings.*option.value;
    std::vector<double> totals;
    double promised = 0;
    for (const FrameRow& row : rows) {
        totals.push_back(row.totalMs.value_or(0));
        promised = std::max({promised, row.promisedAliasingX.value_or(0), row.promisedAliasingZ.value_or(0)});
        s.shadowMaps = std::max(s.shadowMaps, static_cast<int>(row.shadowMaps));
        s.storageFactor = std::max(s.storageFactor, row.storageFactor.value_or(0));
        s.promiseKept = s.promiseKept && row.promiseKept.value_or(true);
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
    s.frameMs = timesAlongPath(rows);
    return s;
}

} // namespace gnomon::app
