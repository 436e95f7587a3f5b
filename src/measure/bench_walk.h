// One run of a bench: a combination of settings, walked along a camera path by this process.
#pragma once

#include "core/progress.h"
#include "executor/executor.h"
#include "measure/session.h"
#include "path/camera_path.h"
#include "proof/frame_proof.h"
#include "telemetry/frame_row.h"

#include <functional>
#include <span>
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
    /// Gets the picture of every frame of the first repetition as a PNG, by the number of its run, if given.
    std::function<void(std::size_t run, int frame, std::span<const std::uint8_t> png)> onPicture;
};

/// What came of one run.
struct RunResult {
    BenchRun run;
    std::vector<telemetry::FrameRow> rows; // repetition by repetition, each in the order of the path
    double cpuMs = 0;                      // of all threads, a logged frame on average
    double firstFrameMs = 0; // from the start of the process to the end of the run's first frame, warm-up or not
};

/// A walk in this process. All must outlive it.
class Walk {
public:
    using OnFrame = std::function<void(int frame, const executor::Picture& picture)>;

    /// `result` names the run and gets what comes of it.
    Walk(Session& session, const path::CameraPath& path, const WalkOptions& options, RunResult& result);

    /// Warm-up, then a row a frame. `onFrame` gets each picture, if given.
    void repeat(int repetition, const OnFrame& onFrame, Progress& progress);

    /// Walks the first repetition once more, untimed and with the same plans, and holds some of its frames against
    /// the oracle.
    void prove(Progress& progress);

    /// Draws `frame` and returns its work: its triangles plus two per pixel, since a pixel costs about two triangles.
    double drawnWork(int frame);

    /// The middle frame, with its legend.
    executor::Picture picture(executor::Overlay overlay, Progress& progress);

private:
    void warmUp(Progress& progress);

    /// Frames evenly over the path, first and last among them.
    bool isProvenFrame(int frame) const;

    double timeOf(int frame) const { return path::frameTime(path_, frame, options_.frames); }

    frame::Frame draw(int frame);

    Session& session_;
    const path::CameraPath& path_;
    const WalkOptions& options_;
    RunResult& result_;
    plan::View view_;
    plan::Quality quality_;
    frame::FrameOptions frameOptions_;
};

} // namespace gnomon::measure
