// The time target: gives up detail and maps while frames take too long, and takes them back when there is time.
#pragma once

#include <optional>
#include <string>

namespace gnomon::viewer {

/// What a frame is drawn with.
struct Effort {
    double errorPixels = 1;
    std::optional<int> slices = 4; // nothing: as many as the plan finds
    bool operator==(const Effort&) const = default;
};

/// One number, the strain, says how much is given up: 0 is nothing, each unit doubles the error in pixels, and from the
/// first on each takes one slice. It moves by the ratio of measured and wanted time, a little every frame, so nothing
/// jumps; a dead band and a margin before a slice comes back keep it from swinging.
class DetailBudget {
public:
    /// Takes in a frame that took `milliseconds` under `effort()`. `target` is in milliseconds, above 0.
    void measure(double milliseconds, double target);

    /// Forgets what was given up.
    void relax();

    /// What to draw with where the user asked for `wanted`.
    Effort effort(const Effort& wanted) const;

    /// "detail 1 -> 2.3 px, maps 4 -> 3"; empty if nothing is given up.
    std::string givenUp(const Effort& wanted) const;

    double strain() const { return strain_; }

    /// Whether everything that can be given up is, so that the target may be missed.
    bool isExhausted() const;

private:
    double strain_ = 0;
    int slicesTaken_ = 0;
};

} // namespace gnomon::viewer
