// The runs of a bench: every combination of the swept settings, walked along one camera path.
#pragma once

#include "core/progress.h"
#include "measure/session.h"
#include "path/camera_path.h"
#include "proof/frame_proof.h"
#include "report/page.h"
#include "telemetry/frame_row.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::measure {

/// One combination of settings.
struct BenchRun {
    std::string name; // the settings that vary between runs, "error_pixels:1/z_partitions:4"; "run" where none does
    settings::Settings settings;
    std::string options; // to paste behind `gnomon render MODEL`: those that vary and those that are not the default
};

/// How each run is walked.
struct WalkOptions {
    int frames = 60;
    int repetitions = 1;
    int warmup = 2;
    bool isRealTime = false;
    proof::Oracle oracle = proof::Oracle::None;
    int provenFrames = 0;           // with an oracle: so many frames, evenly over the path, are held against it
    bool countsWrongPixels = false; // and against integers besides
    /// Gets the picture of every frame of the first repetition, if given.
    std::function<void(const BenchRun& run, int frame, const executor::Picture& picture)> onPicture;
};

/// What came of one run.
struct RunResult {
    BenchRun run;
    std::vector<telemetry::FrameRow> rows; // repetition by repetition, each in the order of the path
    double cpuMs = 0;                      // of all threads, a logged frame on average
    double firstFrameMs = 0; // from the start of the process to the end of the run's first frame, warm-up or not
};

/// One run for each of `settings`, in their order; one for all that draw exact shadows and differ in their maps alone.
std::vector<BenchRun> runsOf(const std::vector<settings::Settings>& settings);

/// Walks every run along `path`: warm-up frames, then `frames` frames evenly over the path, as often as asked. Each
/// repetition walks all runs before the next one begins, so that a machine that slows down slows them all alike. In
/// real time no frame begins before its time on the path. Once all times are taken, each run is walked once more and
/// what its pictures are held against fills its first repetition's columns of accuracy.
std::vector<RunResult> walkAll(
    Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options,
    Progress& progress);

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

/// Those of all `runs`, one after the other. What runs that draw alike show is drawn once. Progress advances by
/// kFramesOfPictures a run.
std::vector<report::Picture> middlePicturesOfAll(
    Session& session,
    const path::CameraPath& path,
    const std::vector<BenchRun>& runs,
    const WalkOptions& options,
    Progress& progress);

/// The frames that `middlePictures` draws.
constexpr std::size_t kFramesOfPictures = 5;

} // namespace gnomon::measure
