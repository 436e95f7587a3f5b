// A small model and camera paths over it, for tests of benches.
#pragma once

#include "bench/bench_runs.h"
#include "core/units.h"
#include "frame/picture_memory.h"
#include "lod/page_store.h"
#include "settings/resolve.h"
#include "tests/support/temporary_model.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::bench {

inline tests::TinyModelOptions hills() {
    tests::TinyModelOptions options;
    options.gridExponent = 6;
    options.height = 8;
    options.clusterTriangles = 32;
    return options;
}

inline const std::string& model() {
    static const tests::TemporaryModel file(hills());
    return file.path();
}

inline settings::Settings smallSettings() {
    settings::Settings settings;
    settings.quality.shadows = plan::ShadowMode::Maps;
    settings.imageSize = {96, 96};
    settings.backend = settings::Backend::Software;
    settings.quality.shadowTexelsWidth = settings.quality.shadowTexelsHeight = 256;
    settings.quality.errorPixels = 0.2;
    return settings;
}

/// Returns a value of `--memory` that has room for `fraction` of the model's pages.
inline Bytes memoryFor(double fraction, plan::ShadowMode shadows = plan::ShadowMode::Maps, int samples = 1) {
    const hierarchy::ModelFile file(model());
    double bytes = 0;
    for (const hierarchy::PageInfo& page : file.pages())
        bytes += static_cast<double>(lod::decodedBytes(page).count) * fraction;
    settings::Settings settings = smallSettings();
    settings.quality.shadows = shadows;
    const plan::View view = settings::viewOf(settings, file.summary());
    frame::FrameOptions options;
    options.isAccumulated = samples > 1;
    const Bytes picture = frame::pictureBytes(view, settings::qualityOf(settings), options);
    // Pages get two thirds of the memory that remains after program, tables and picture.
    return {
        mebibytes(64).count + frame::tableBytes(file).count + picture.count + static_cast<std::uint64_t>(1.5 * bytes)};
}

/// Returns a low flight across the hills that takes half a second.
inline path::CameraPath flight() {
    const auto key = [](double time, const glm::dvec3& eye, const glm::dvec3& target) {
        return path::Keyframe{time, {eye, target, {0, 1, 0}, 1}};
    };
    path::CameraPath path;
    path.keyframes = {
        key(0, {3, 12, 3}, {30, 3, 30}), key(0.2, {30, 10, 20}, {50, 3, 30}), key(0.5, {45, 20, 50}, {10, 0, 30})};
    return path;
}

inline WalkOptions frames(int count, bool isRealTime = false) {
    WalkOptions options;
    options.frames = count;
    options.warmup = 0;
    options.isRealTime = isRealTime;
    return options;
}

/// Returns the results of all runs.
inline std::vector<RunResult> walkAlone(
    task::Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options,
    Progress& progress) {
    return walkAll({session, path, runs, options}, progress);
}

inline RunResult walked(
    task::Session& session, const settings::Settings& view, const path::CameraPath& path, const WalkOptions& options) {
    NoProgress progress;
    return walkAlone(session, path, runsOf({view}), options, progress).front();
}

/// Returns the cells of each row that must be reproducible, without times.
inline std::vector<std::string> timeless(const RunResult& result) {
    std::vector<std::string> cells;
    for (telemetry::FrameRow row : result.rows) {
        row.planMs = row.selectMs = row.cullMs = row.streamMs = row.shadowMs = row.imageMs = row.totalMs = 0;
        row.sinceStartMs = 0;
        cells.push_back(telemetry::csvRow(row));
    }
    return cells;
}

/// Fails the test; used for models without damage.
inline void failOnWarning(const std::string& warning) {
    ADD_FAILURE() << warning;
}

} // namespace gnomon::bench
