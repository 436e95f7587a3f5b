// The pictures and files that `gnomon render` writes. They do not include the settings of the view and its quality.
#pragma once

#include "render/overlay/overlay.h"
#include "settings/value_colors.h"
#include "validation/ground_truth_kind.h"

#include <optional>
#include <string>

namespace gnomon::settings {

inline constexpr int kUsualSamples = 16;
inline constexpr int kMaxSamples = 65535;

/// The pictures that the user requests, and the additional files of a single picture. An empty path means that the file
/// is not requested.
struct Output {
    std::string picture{};        // PNG; for several pictures a pattern such as frame%04d.png, or "-" for YUV4MPEG2
    std::optional<int> samples{}; // frames per picture; nullopt: see samplesOf
    render::Overlay overlay = render::Overlay::None;
    ValueColors colors{};         // replace the colours of the model
    std::string path{};           // file of a camera path; several pictures are drawn along it
    std::optional<int> frames{};  // number of these pictures; nullopt: 60
    int turntable = 0;            // number of pictures on a circle around the target; 0: no turntable
    std::optional<double> time{}; // seconds; if given, the camera file is a path, and its camera at this time is used
    std::string statistics{};     // JSON file with the log row of the frame
    std::string reference{};      // PNG file that is compared with the picture
    double referenceThreshold = 0.01; // max mean difference, fraction of full scale
    std::string depth{};              // PFM file with view depths
    std::string shadowClasses{};      // PNG file with the shadow class of each pixel
    std::string shadowDepth{};        // folder for the shadow maps as PFM files
    validation::GroundTruth groundTruth = validation::GroundTruth::None;

    bool isSeries() const { return !path.empty() || turntable > 0; }
};

/// Returns how many frames are averaged for a picture. This is the number that the user requests. Otherwise it is 1 if
/// an output shows a single frame (overlay, colours by value, ground truth, or an additional file), else kUsualSamples.
int samplesOf(const Output& output);

/// Returns true if a requested output shows or measures shadow maps.
bool needsMaps(const Output& output);

} // namespace gnomon::settings
