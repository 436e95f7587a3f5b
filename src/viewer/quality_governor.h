// The quality governor keeps the frame time of the window below a target. It reduces the quality while frames take too
// long, and restores it when there is time.
#pragma once

#include "plan/frame_plan.h"
#include "telemetry/frame_row.h"

#include <array>
#include <optional>
#include <string>

namespace gnomon::viewer {

/// The quality settings of a frame.
struct QualityLevel {
    double errorPixels = 1;        // pixels of the window
    std::optional<int> slices = 4; // nothing: the plan chooses the number
    int texelsWidth = 2048;        // of all maps together
    int texelsHeight = 2048;
    double resolution = 1;  // pixels that are drawn over those of the window, along a side
    bool mayBeExact = true; // shadows of kind auto may be exact
    bool operator==(const QualityLevel&) const = default;
};

/// The kinds of quality that the quality governor can reduce.
enum class QualityKind : std::uint8_t { Detail, Slices, Texels, Resolution, Exactness };
inline constexpr std::size_t kQualityKinds = 5;

/// The errors of a frame's shadows in drawn pixels, according to the plan of the frame. A value is missing if there are
/// no shadow maps or no cheaper plan.
struct ShadowErrors {
    std::optional<double> aliasingBound; // max perspective aliasing of this plan
    std::optional<double> fewerSlices;   // aliasing bound with one slice less
    std::optional<double> fewerTexels;   // aliasing bound with half the texels
    std::optional<double> withMaps;      // aliasing bound of shadow maps in place of exact shadows of kind auto
    double texelShare = 0; // part of the maps' estimated cost that depends on texels; the rest depends on casters
};

/// Returns the shadow errors of `plan`. If `withLess` is true, also returns those of cheaper plans for the same scene.
ShadowErrors shadowErrors(const plan::FramePlan& plan, const plan::SceneFacts& facts, bool withLess);

/// The measured times and triangle counts of a frame.
struct FrameLoad {
    double milliseconds = 0; // time of the whole frame
    double imageMs = 0;
    double shadowMs = 0;
    double triangles = 0; // triangles of the image
    double pixels = 0;
    bool resolvesPoints = false; // shadows are computed per visible point, without maps
    ShadowErrors errors;
};

/// Reduces the quality of frames in steps. A step is half an octave of the error in pixels, one slice, half of the
/// texels, half of the pixels (down to half of the resolution), or shadow maps in place of exact shadows. The governor
/// selects the step with the smallest error per saved time. Errors are in pixels of the window. The errors of detail
/// and resolution are known. The error of shadow maps is the max perspective aliasing of the plan. Saved times follow
/// from the measured times and counts of the stages. The governor learns how many triangles a coarser level of detail
/// saves, because many small parts do not become fewer. It compares the times of exact shadows and of maps when one
/// kind follows the other. Two consecutive frames above the target cause a step. Twelve frames that would stay below
/// the target cause a step back. A single slow frame changes nothing. The result depends only on the measured values,
/// not on a clock.
class QualityGovernor {
public:
    /// Updates the quality after a frame that was drawn with `level(wanted)`. `target` is the target frame time in
    /// milliseconds, above 0.
    void measure(const FrameLoad& load, double target, const QualityLevel& wanted);

    /// Restores the full quality that the user chose.
    void relax();

    /// Returns the quality for the next frame: `wanted`, which the user chose, with all present reductions.
    QualityLevel level(const QualityLevel& wanted) const;

    /// Returns a text that lists the present reductions, for example "detail 1 -> 2.8 px, slices 4 -> 3, texels
    /// 2048x2048 -> 1448x1448, resolution 71%". The text is empty at full quality.
    std::string reductions(const QualityLevel& wanted) const;

    /// Returns true if the last frames exceeded the target time and no further reduction of quality would save time.
    bool isExhausted() const { return isExhausted_; }

private:
    using Steps = std::array<int, kQualityKinds>;

    /// A step of one kind of quality. As a reduction, it adds `error` and saves `milliseconds` per frame. As a step
    /// back, it removes `error` and adds `milliseconds`.
    struct Change {
        QualityKind kind = QualityKind::Detail;
        double error = 0;        // pixels
        double milliseconds = 0; // above 0
    };

    static int maxSteps(QualityKind kind, const QualityLevel& wanted);
    static QualityLevel levelAt(const Steps& steps, const QualityLevel& wanted);

    Change reduction(QualityKind kind, const FrameLoad& load, const QualityLevel& now) const;
    Change restoration(QualityKind kind, const FrameLoad& load, const QualityLevel& now) const;
    std::optional<Change> cheapest(const FrameLoad& load, const QualityLevel& wanted) const;
    std::optional<Change> costliest(const FrameLoad& load, double target, const QualityLevel& wanted) const;
    double detailMs(const FrameLoad& load) const;
    double pixelMs(const FrameLoad& load) const;
    void learn(const FrameLoad& load);
    void reduce(FrameLoad load, double target, const QualityLevel& wanted);
    void restore(FrameLoad load, double target, const QualityLevel& wanted);

    int& step(QualityKind kind) { return steps_[static_cast<std::size_t>(kind)]; }

    int step(QualityKind kind) const { return steps_[static_cast<std::size_t>(kind)]; }

    Steps steps_{};
    double elasticity_ = 0.5;       // exponent e of the model: number of triangles ~ error^-e
    double exactOverMaps_ = 2;      // last measured ratio of shadow times: exact shadows divided by maps
    double exactMs_ = 0;            // shadow time of the last exact frame; 0 after a frame with maps
    double trianglesBefore_ = 0;    // triangles of the last frame
    int detailBefore_ = 0;          // steps of detail in the last frame
    double millisecondsBefore_ = 0; // time of the last frame; 0 if the quality has changed since
    bool isExhausted_ = false;
    int framesWithTime_ = 0; // consecutive frames whose predicted time after a step back fits the target
};

} // namespace gnomon::viewer
