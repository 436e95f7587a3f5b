// Computes a walk through a model. The camera moves over the floors from room to room, at eye height and clear of
// obstacles.
#pragma once

#include "hierarchy/model_file.h"
#include "path/camera_path.h"

#include <optional>

namespace gnomon::path {

/// The options of a walk.
struct WalkOptions {
    std::optional<int> storey; // only this storey, counted from the lowest (0); default: all storeys
    /// Height of the eye above the floor, in world units, above 0. The default is 1.7 if the unit is metres, else an
    /// estimate.
    std::optional<double> eyeHeight;
};

/// Returns a walk on the floors of `model`, in upright space (hierarchy/upright_frame.h) and in the model's unit. The
/// walk takes at most one minute at 1.4 m/s (for an eye at 1.7) and looks ahead along the way. Floors are found with
/// voxels (Mononen 2009). The eye stays 0.15 m clear of all geometry. The body passes below ceilings, between walls and
/// over steps like a person.
///
/// In a model larger than 80 m, the walk uses the part with the most floor below ceilings and beside objects. A model
/// that is too small for metres and has no floor counts as an object on a ground: the walk leads around it. Throws
/// Error if there is no floor or no such storey.
CameraPath walk(const hierarchy::ModelFile& model, const WalkOptions& options);

} // namespace gnomon::path
