// The pictures and files that a render makes, beside the view and its quality.
#pragma once

#include "render/overlay/overlay.h"
#include "settings/value_colors.h"
#include "validation/ground_truth_kind.h"

#include <optional>
#include <string>

namespace gnomon::settings {

inline constexpr int kUsualSamples = 16;
inline constexpr int kMaxSamples = 65535;

/// The requested pictures, and the files of one picture. An empty path is no file.
struct Output {
    std::string picture{};        // a PNG; of several pictures a pattern such as frame%04d.png, or "-" for YUV4MPEG2
    std::optional<int> samples{}; // frames per picture; nothing: see samplesOf
    render::Overlay overlay = render::Overlay::None;
    ValueColors colors{};         // in place of the model's own
    std::string path{};           // a camera path: several pictures along it
    std::optional<int> frames{};  // the number of these pictures; nothing: 60
    int turntable = 0;            // the number of pictures all around the target; 0: no turntable
    std::optional<double> time{}; // seconds: the camera file is a path, and its camera at this time sees the picture
    std::string statistics{};     // the frame's row of the log, JSON
    std::string reference{};      // a PNG that is compared with the picture
    double referenceThreshold = 0.01; // max mean difference, fraction of full scale
    std::string depth{};              // view depths, PFM
    std::string shadowDepth{};        // a folder for the shadow maps, PFM
    validation::GroundTruth groundTruth = validation::GroundTruth::None;

    bool isSeries() const { return !path.empty() || turntable > 0; }
};

/// Returns the frames per picture: the requested number, else 1 if an output is of one frame, else kUsualSamples.
int samplesOf(const Output& output);

/// Returns whether `output` shows or measures shadow maps.
bool needsMaps(const Output& output);

} // namespace gnomon::settings
