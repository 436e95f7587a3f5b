#include "bench/bench_output.h"

#include "bench/result_json.h"
#include "core/file.h"
#include "core/formatted.h"
#include "report/accuracy_cost.h"
#include "settings/table.h"
#include "shadow/scheme.h"
#include "telemetry/benchmark_report.h"

#include <algorithm>
#include <filesystem>

namespace gnomon::bench {

namespace {

/// Returns what identifies the source of a model: its numbers of triangles and vertices, and its bounds. The file does
/// not contain a hash of the source.
std::string sourceOf(const hierarchy::ModelSummary& summary) {
    const Box& box = summary.bounds;
    return formatted(
        "%llu triangles, %llu vertices, %.6g,%.6g,%.6g to %.6g,%.6g,%.6g",
        static_cast<unsigned long long>(summary.sourceTriangles),
        static_cast<unsigned long long>(summary.sourceVertices),
        box.min.x,
        box.min.y,
        box.min.z,
        box.max.x,
        box.max.y,
        box.max.z);
}

/// Returns the values of the settings that change the picture but that no bench sweeps, also the default values.
std::string pictureOf(const settings::Settings& settings) {
    std::string text;
    for (const char* name :
         {"projection", "shading", "ambient", "background", "ground", "sky", "sun-angle", "section"}) {
        const settings::Setting& setting = settings::named(name);
        const std::string value = setting.text(settings);
        text += (text.empty() ? "" : ", ") + setting.column() + " " + (value.empty() ? "default" : value);
    }
    return text + ", samples 1, fov_y from the path";
}

} // namespace

std::map<std::string, std::string> statedSettings(const std::vector<BenchRun>& runs) {
    std::map<std::string, std::string> stated;
    for (const settings::Setting& setting : settings::table()) {
        const settings::Description& description = setting.description();
        const std::string value = setting.text(runs.front().settings);
        if (description.isSwept) {
            const auto isThis = [&](const BenchRun& run) { return setting.text(run.settings) == value; };
            if (std::all_of(runs.begin(), runs.end(), isThis)) stated[setting.column()] = value;
        } else if (!description.statedAs.empty()) { // several settings can share a key, such as near and far
            std::string& text = stated[description.statedAs];
            text += (text.empty() ? "" : ", ") + (value.empty() ? "not given" : value);
        }
    }
    return stated;
}

std::map<std::string, std::string> statedFacts(
    const std::vector<BenchRun>& runs, const path::CameraPath& path, const WalkOptions& walk, task::Session& session) {
    std::map<std::string, std::string> context = telemetry::machineContext();
    context.erase("host_name"); // reports are given to other people
    const hierarchy::ModelFile& model = session.model();
    context["model"] = std::filesystem::path(model.path()).filename().string();
    context["model_triangles"] = std::to_string(model.summary().sourceTriangles);
    context["model_content_hash"] = model.contentHash();
    context["model_source"] = sourceOf(model.summary());
    context["picture"] = pictureOf(runs.front().settings);
    context["path_content_hash"] = path::contentHash(path);
    context.merge(statedSettings(runs));
    context["backend"] = session.backend().name();
    context["warmup_frames"] = std::to_string(walk.warmup);
    context["frames"] = std::to_string(walk.frames);
    context["repetitions"] = std::to_string(walk.repetitions);
    context["real_time"] = walk.isRealTime ? "yes" : "no: frames wait until their cut is resident";
    return context;
}

std::string csvText(const std::vector<RunResult>& results) {
    std::string text = telemetry::csvHeader() + "\n";
    for (const RunResult& result : results)
        for (const telemetry::FrameRow& row : result.rows)
            text += telemetry::csvRow(row) + "\n";
    return text;
}

void writePictures(const std::string& folder, std::size_t run, const std::vector<report::Picture>& pictures) {
    const std::string stem = (std::filesystem::path(folder) / ("run" + std::to_string(run))).string();
    for (const report::Picture& picture : pictures)
        writeTextFile(
            stem + (picture.kind == "picture" ? "" : "_" + picture.kind) + ".png",
            {picture.png.begin(), picture.png.end()});
}

void writeFramePicture(const std::string& folder, std::size_t run, int frame, std::span<const std::uint8_t> png) {
    const std::string name = formatted("run%zu_frame%04d.png", run, frame);
    writeTextFile((std::filesystem::path(folder) / name).string(), {png.begin(), png.end()});
}

std::vector<std::size_t> picturedRuns(const std::vector<report::RunSummary>& summaries) {
    std::vector<std::size_t> runs = report::paretoFront(summaries, report::leadingError(summaries));
    runs.push_back(0);
    std::sort(runs.begin(), runs.end());
    runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
    return runs;
}

void writeReport(
    const std::string& folder, report::Report page, const std::vector<RunResult>& results, const ResultSet& set) {
    const auto place = [&](const std::string& name) { return (std::filesystem::path(folder) / name).string(); };
    page.csvFile = "bench.csv";
    page.jsonFile = "bench.json";
    writeTextFile(place(page.csvFile), csvText(results));
    writeTextFile(place(page.jsonFile), resultJson(set));
    writeTextFile(place("index.html"), report::page(page));
}

std::vector<report::StoragePoint> storagePoints(const plan::FramePlan& plan) {
    std::vector<report::StoragePoint> points;
    if (!(plan.near > 0 && plan.far > plan.near)) return points;
    const shadow::ViewFrustum frustum{plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    const auto add = [&](const char* name, shadow::WarpRule warp, bool faces) {
        for (int k = 1; k <= 8; ++k) {
            shadow::Scheme scheme;
            scheme.warp.rule = warp;
            scheme.slices = k;
            scheme.faces = faces;
            const auto maps = shadow::schemeMaps(frustum, plan.towardsLight, scheme);
            points.push_back({name, static_cast<int>(maps.size()), shadow::storageFactor(maps)});
        }
    };
    add("slices", shadow::WarpRule::None, false);
    add("slices + warp", shadow::WarpRule::Auto, false);
    add("faces + slices + warp", shadow::WarpRule::Auto, true);
    add("faces + logarithmic rows", shadow::WarpRule::Log, true);
    return points;
}

} // namespace gnomon::bench
