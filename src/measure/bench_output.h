// What a bench writes down: its context, its log, its benchmark document and the storage factors of its page.
#pragma once

#include "measure/bench_runs.h"
#include "report/page.h"

#include <map>
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

/// The storage factors of slices with and without warp and of faces, for the depth range of `plan`.
std::vector<report::StoragePoint> storagePoints(const plan::FramePlan& plan);

} // namespace gnomon::measure
