// The output of a bench: context, log, benchmark JSON, pictures and report page.
#pragma once

#include "bench/bench_runs.h"
#include "bench/result_set.h"
#include "report/page.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::bench {

/// Returns the settings for the context of a bench, with their texts: the settings that a bench does not sweep, and the
/// swept settings with the same value in all `runs`. The names of the runs contain all other settings.
std::map<std::string, std::string> statedSettings(const std::vector<BenchRun>& runs);

/// Returns the context of a bench, with which a reader can judge or repeat the results: machine, model, camera path,
/// settings, backend and numbers of frames. It does not contain the name of the host.
std::map<std::string, std::string> statedFacts(
    const std::vector<BenchRun>& runs, const path::CameraPath& path, const WalkOptions& walk, task::Session& session);

/// Returns the log as CSV: a header line and one row per frame.
std::string csvText(const std::vector<RunResult>& results);

/// Writes the pictures of run `run` as runN.png (the picture) and runN_KIND.png (all other kinds) into `folder`.
void writePictures(const std::string& folder, std::size_t run, const std::vector<report::Picture>& pictures);

/// Writes the bytes `png` as runN_frameMMMM.png into `folder`.
void writeFramePicture(const std::string& folder, std::size_t run, int frame, std::span<const std::uint8_t> png);

/// Returns the indices of the runs whose pictures are in the report: the Pareto front of time and error, and run 0.
std::vector<std::size_t> picturedRuns(const std::vector<report::RunSummary>& summaries);

/// Writes the report into `folder`: index.html, bench.csv and bench.json. The files do not contain the name of the
/// host, because reports are given to other people.
void writeReport(
    const std::string& folder, report::Report page, const std::vector<RunResult>& results, const ResultSet& set);

/// Returns the storage factors of four schemes with 1 to 8 slices each, for the frustum and the light of `plan`. The
/// schemes are slices, warped slices, warped slices with faces, and logarithmic slices with faces.
std::vector<report::StoragePoint> storagePoints(const plan::FramePlan& plan);

} // namespace gnomon::bench
