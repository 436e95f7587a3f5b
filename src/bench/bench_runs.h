// The runs of a bench: each combination of the swept settings, walked along one camera path.
#pragma once

#include "bench/bench_walk.h"
#include "report/page.h"

#include <set>
#include <string>
#include <vector>

namespace gnomon::bench {

/// Returns one run per element of `settings`, in their order. Elements that draw exact shadows and differ only in
/// settings of shadow maps have one common run. `given` are the columns of the settings that the user gives; the scheme
/// of each run contains them, so that the run has the same name in a smaller or larger sweep.
std::vector<BenchRun> runsOf(const std::vector<settings::Settings>& settings, const std::set<std::string>& given = {});

/// Returns the settings from which the backend of all runs is made: the settings of the first run that needs the
/// software backend, or else of the first run.
settings::Settings backendSettings(const std::vector<BenchRun>& runs);

/// The input of the walks of a bench. All references must outlive it.
struct BenchWalks {
    task::Session& session;
    const path::CameraPath& path;
    const std::vector<BenchRun>& runs;
    const WalkOptions& options;
};

/// Walks all runs along the path and returns their results. Each walk draws warm-up frames, and then `frames` frames at
/// even times of the path. Each repetition walks all runs before the next repetition begins, so that a slower machine
/// slows all runs equally. In real time, a frame does not begin before its time on the path. With a ground truth
/// (option --oracle), an additional untimed walk per run fills the accuracy columns of the first repetition.
std::vector<RunResult> walkAll(const BenchWalks& walks, Progress& progress);

/// Walks only run `run`, without a comparison with the ground truth. Progress advances by frames times repetitions.
RunResult walkAgain(const BenchWalks& walks, std::size_t run, Progress& progress);

/// The max work of all frames of a quick bench, in triangles (see Walk::drawnWork). On two cores of 2026, such a bench
/// takes less than two minutes with its validation.
inline constexpr double kQuickWork = 1.2e9;

/// Returns the number of frames per run of a quick bench, from 1 to `options.frames`, so that the estimated work is at
/// most kQuickWork. The estimate is the max work of three frames of the first run. It uses no clock, so it is the same
/// each time.
int quickFrames(
    task::Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options);

/// Returns the number of frames by which `walkAll` advances its progress.
std::size_t frameCount(const std::vector<BenchRun>& runs, const WalkOptions& options);

/// Draws the frame in the middle of the path and returns six pictures for the report:
/// - picture;
/// - reference, the same with ray-traced shadows;
/// - difference, four times the absolute difference of both;
/// - texels, aliasing and partitions, the picture with these overlays.
/// Progress advances by kFramesOfPictures.
std::vector<report::Picture> middlePictures(
    task::Session& session,
    const path::CameraPath& path,
    const BenchRun& run,
    const WalkOptions& options,
    Progress& progress);

/// Returns the middle pictures of the runs `which` (indices), in this order. Runs with identical pictures are drawn
/// once. Progress advances by kFramesOfPictures per run.
std::vector<report::Picture> middlePicturesOfAll(
    const BenchWalks& walks, const std::vector<std::size_t>& which, Progress& progress);

/// The number of frames that `middlePictures` draws.
constexpr std::size_t kFramesOfPictures = 5;

} // namespace gnomon::bench
