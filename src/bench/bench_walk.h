// One run of a bench: a combination of settings whose frames are drawn along a camera path.
#pragma once

#include "core/progress.h"
#include "path/camera_path.h"
#include "render/backend.h"
#include "task/session.h"
#include "telemetry/frame_row.h"
#include "validation/frame_validation.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::bench {

/// A combination of settings with its name.
struct BenchRun {
    std::string name; // settings that vary between runs: "error_pixels:1/z_partitions:4"; "run" if no setting varies
    settings::Settings settings;
    std::string options;  // for `gnomon render MODEL`: the settings that vary or differ from the default
    std::string scheme{}; // for names in files: the shadow method and the settings that vary or are given
    std::string error{};  // for names in files: "2px", or "default" if the max error is not given
};

/// The options that all runs share.
struct WalkOptions {
    int frames = 60;
    int repetitions = 1;
    int warmup = 2;
    bool isRealTime = false;
    validation::GroundTruth groundTruth = validation::GroundTruth::None;
    int provenFrames = 0;           // number of frames, evenly over the path, that are compared with `groundTruth`
    bool countsWrongPixels = false; // also compares these frames with integer arithmetic
    /// Called with the picture of each frame of the first repetition, as the bytes of a PNG. Can be empty.
    std::function<void(std::size_t run, int frame, std::span<const std::uint8_t> png)> onPicture;
};

/// The measurements of one run.
struct RunResult {
    BenchRun run;
    std::vector<telemetry::FrameRow> rows; // one per frame, ordered by repetition, then by frame
    double cpuMs = 0;                      // processor time of all threads, mean per logged frame
    std::vector<double> rowCpuMs;          // processor time of all threads, per row
    double firstFrameMs = 0; // from the start of the process to the end of the run's first frame, with warm-up frames
};

/// Draws the frames of one run along a camera path. All arguments of the constructor must outlive it.
class Walk {
public:
    using OnFrame = std::function<void(int frame, const render::Picture& picture)>;

    /// `result.run` is the run to walk. The functions of this class add the measurements to `result`.
    Walk(task::Session& session, const path::CameraPath& path, const WalkOptions& options, RunResult& result);

    /// Draws the warm-up frames and then one repetition. Adds one row per frame to the result. Calls `onFrame` with
    /// each picture if it is not empty.
    void repeat(int repetition, const OnFrame& onFrame, Progress& progress);

    /// Draws the frames of the first repetition again, without timing and with the same plans. Compares `provenFrames`
    /// of them with the ground truth and fills their accuracy columns.
    void validate(Progress& progress);

    /// Draws `frame` and returns its work: the number of triangles plus two per pixel, because a pixel costs about as
    /// much as two triangles.
    double drawnWork(int frame);

    /// Draws the middle frame with `overlay` and its legend.
    render::Picture picture(render::Overlay overlay, Progress& progress);

private:
    void warmUp(Progress& progress);

    /// Returns true if `frame` is compared with the ground truth. These frames are even over the path, with its first
    /// and last frame. A single one is the middle frame.
    bool isProvenFrame(int frame) const;

    double timeOf(int frame) const { return path::frameTime(path_, frame, options_.frames); }

    frame::Frame draw(int frame);

    task::Session& session_;
    const path::CameraPath& path_;
    const WalkOptions& options_;
    RunResult& result_;
    plan::View view_;
    plan::Quality quality_;
    frame::FrameOptions frameOptions_;
    frame::History history_;
};

} // namespace gnomon::bench
