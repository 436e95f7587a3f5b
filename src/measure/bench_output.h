// What a bench writes down: its context, its log, its benchmark document and the storage factors of its page.
#pragma once

#include "measure/bench_runs.h"
#include "report/page.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::measure {

/// The settings that are stated of a bench: those that no bench sweeps, and those that are the same in all of `runs`;
/// the others are in the names of the runs.
std::map<std::string, std::string> statedSettings(const std::vector<BenchRun>& runs);

/// What a reader must know to judge or repeat the figures, as far as the machine, the model, the path and the walk say
/// it.
std::map<std::string, std::string> statedFacts(
    const std::vector<BenchRun>& runs, const path::CameraPath& path, const WalkOptions& walk, Session& session);

/// The log: a header line and a row a frame.
std::string csvText(const std::vector<RunResult>& results);

/// A document of the shape of Google Benchmark's.
std::string benchmarkText(const std::map<std::string, std::string>& context, const std::vector<RunResult>& results);

/// Writes the pictures of run `run` into `folder`, under its number.
void writePictures(const std::string& folder, std::size_t run, const std::vector<report::Picture>& pictures);

/// Writes a PNG into `folder` under the numbers of its run and frame.
void writeFramePicture(const std::string& folder, std::size_t run, int frame, std::span<const std::uint8_t> png);

/// The runs whose pictures a report holds: those that no other beats in time and error, and the first.
std::vector<std::size_t> picturedRuns(const std::vector<report::RunSummary>& summaries);

/// Writes the page into `folder`, its log and its benchmark document beside it. They name no host: a report is handed
/// around.
void writeReport(const std::string& folder, report::Report page, const std::vector<RunResult>& results);

/// The storage factors of slices with and without warp and of faces, for the depth range of `plan`.
std::vector<report::StoragePoint> storagePoints(const plan::FramePlan& plan);

} // namespace gnomon::measure
