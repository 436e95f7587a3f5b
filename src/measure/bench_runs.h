// The runs of a bench: every combination of the swept settings, walked along one camera path by whoever is free.
#pragma once

#include "measure/bench_walk.h"
#include "report/page.h"

#include <string>
#include <vector>

namespace gnomon::measure {

/// One run for each of `settings`, in their order; one for all that draw exact shadows and differ in their maps alone.
std::vector<BenchRun> runsOf(const std::vector<settings::Settings>& settings);

/// The settings that the executor of all runs is made by: those of a run that needs the software backend, if one does.
settings::Settings backendSettings(const std::vector<BenchRun>& runs);

/// What a bench walks. All must outlive it.
struct BenchWalks {
    Session& session;
    const path::CameraPath& path;
    const std::vector<BenchRun>& runs;
    const WalkOptions& options;
};

/// Walks every run along the path: warm-up frames, then `frames` frames evenly over the path, as often as asked. Each
/// repetition walks all runs before the next one begins, so that a machine that slows down slows them all alike. In
/// real time no frame begins before its time on the path. Once all times are taken, each run is walked once more and
/// what its pictures are held against fills its first repetition's columns of accuracy.
std::vector<RunResult> walkAll(const BenchWalks& walks, Progress& progress);

/// Walks `run` alone, and holds it against nothing. Progress advances by frames times repetitions.
RunResult walkAgain(const BenchWalks& walks, std::size_t run, Progress& progress);

/// What all frames of a quick bench may work through, in triangles: on two cores of 2026 they then take under two
/// minutes with their proofs.
inline constexpr double kQuickWork = 1.2e9;

/// How many frames of each run a quick bench walks: at most `options.frames`, fewer where all of them would come to
/// more than kQuickWork, at least one. It is counted from three frames of the first run and not timed, so it repeats.
int quickFrames(
    Session& session, const path::CameraPath& path, const std::vector<BenchRun>& runs, const WalkOptions& options);

/// What the progress of `walkAll` counts up to.
std::size_t frameCount(const std::vector<BenchRun>& runs, const WalkOptions& options);

/// The frame in the middle of the path as a report shows it: picture, reference (the same with ray-traced shadows),
/// difference (four times the absolute difference of the two), texels, aliasing, partitions. Progress advances by
/// kFramesOfPictures.
std::vector<report::Picture> middlePictures(
    Session& session,
    const path::CameraPath& path,
    const BenchRun& run,
    const WalkOptions& options,
    Progress& progress);

/// Those of all `which` of the runs, one after the other. What runs that draw alike show is drawn once. Progress
/// advances by kFramesOfPictures a run.
std::vector<report::Picture> middlePicturesOfAll(
    const BenchWalks& walks, const std::vector<std::size_t>& which, Progress& progress);

/// The frames that `middlePictures` draws.
constexpr std::size_t kFramesOfPictures = 5;

} // namespace gnomon::measure
