// The quality governor of the time target: it reduces quality while frames take too long, and restores it when there is
// time.
#pragma once

#include "plan/frame_plan.h"
#include "telemetry/frame_row.h"

#include <array>
#include <optional>
#include <string>

namespace gnomon::viewer {

/// The quality settings of a frame.
struct Effort {
    double errorPixels = 1;        // pixels of the window
    std::optional<int> slices = 4; // nothing: the plan chooses the number
    int texelsWidth = 2048;        // of all maps together
    int texelsHeight = 2048;
    double resolution = 1;  // pixels that are drawn over those of the window, along a side
    bool mayBeExact = true; // shadows of kind auto may be exact
    bool operator==(const Effort&) const = default;
};

/// The kinds of quality that the governor can reduce.
enum class Lever : std::uint8_t { Detail, Slices, Texels, Resolution, Exactness };
inline constexpr std::size_t kLevers = 5;

/// The errors of a frame's shadows according to its plan, in drawn pixels. A value is missing if there are no maps or
/// no cheaper plan.
struct ShadowErrors {
    std::optional<double> promised;    // perspective aliasing
    std::optional<double> fewerSlices; // with one slice less
    std::optional<double> fewerTexels; // with half the texels
    std::optional<double> asMaps;      // of shadow maps in place of exact shadows of kind auto
    double texelShare = 0;             // of the counted cost of its maps; the rest is their casters'
};

/// Returns the errors of `plan`. If `withLess` is true, also returns the errors of cheaper plans for the same scene.
ShadowErrors shadowErrors(const plan::FramePlan& plan, const plan::SceneFacts& facts, bool withLess);

/// The measured times and counts of a frame.
struct FrameLoad {
    double milliseconds = 0; // whole frame
    double imageMs = 0;
    double shadowMs = 0;
    double triangles = 0; // of the image
    double pixels = 0;
    bool decidesPoints = false; // shadows are computed per image point, without maps
    ShadowErrors errors;
};

/// Gives up, a step at a time, what costs the least error for the time that it saves: detail by half octaves of the
/// error in pixels, a slice, half the texels, half the pixels (down to half the resolution), exact shadows for maps.
/// Errors are the plan's figures in pixels of the window: those of detail and resolution are known, those of maps
/// promised. Savings follow from what the frame's stages took and counted; how far fewer triangles a coarser cut has is
/// learned, since parts that are many and small do not get fewer. How much longer exact shadows take than maps is
/// measured when the one kind follows the other. A step is taken where two frames on end are over the
/// target, and back where twelve would hold it: one slow frame moves nothing. A pure function of what is measured,
/// without a clock.
class DetailBudget {
public:
    /// Processes a frame that was drawn with `effort(wanted)`. `target` is in milliseconds, above 0.
    void measure(const FrameLoad& load, double target, const Effort& wanted);

    /// Restores full quality.
    void relax();

    /// Returns the quality to draw with if the user chose `wanted`.
    Effort effort(const Effort& wanted) const;

    /// Returns a description of the reductions, for example "detail 1 -> 2.8 px, slices 4 -> 3, texels 2048x2048 ->
    /// 1448x1448, resolution 71%". Returns an empty text at full quality.
    std::string givenUp(const Effort& wanted) const;

    /// Returns true if no further step would save time and the last frames exceeded the target.
    bool isExhausted() const { return isExhausted_; }

private:
    using Steps = std::array<int, kLevers>;

    /// A step of a lever: it costs error on the way down and time on the way back.
    struct Change {
        Lever lever = Lever::Detail;
        double error = 0;        // pixels
        double milliseconds = 0; // above 0
    };

    static int most(Lever lever, const Effort& wanted);
    static Effort effortOf(const Steps& steps, const Effort& wanted);

    Change giveUp(Lever lever, const FrameLoad& load, const Effort& now) const;
    Change takeBack(Lever lever, const FrameLoad& load, const Effort& now) const;
    std::optional<Change> cheapest(const FrameLoad& load, const Effort& wanted) const;
    std::optional<Change> dearest(const FrameLoad& load, double target, const Effort& wanted) const;
    double detailMs(const FrameLoad& load) const;
    double pixelMs(const FrameLoad& load) const;
    void learn(const FrameLoad& load);
    void shed(FrameLoad load, double target, const Effort& wanted);
    void restore(FrameLoad load, double target, const Effort& wanted);

    int& step(Lever lever) { return steps_[static_cast<std::size_t>(lever)]; }

    int step(Lever lever) const { return steps_[static_cast<std::size_t>(lever)]; }

    Steps steps_{};
    double elasticity_ = 0.5;       // of triangles to the error: T ~ error^-elasticity
    double exactOverMaps_ = 2;      // the shadow time of exact shadows over that of maps: as measured last
    double exactMs_ = 0;            // the shadow time of the last frame with exact shadows; 0: maps have followed it
    double trianglesBefore_ = 0;    // of the last frame
    int detailBefore_ = 0;          // its steps
    double millisecondsBefore_ = 0; // likewise; 0 where levers have moved since
    bool isExhausted_ = false;
    int framesWithTime_ = 0; // consecutive frames that would stay within the target after a step back
};

} // namespace gnomon::viewer
