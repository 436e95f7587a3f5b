// A walk through a model: over its floors, from room to room, with the eye at eye height and clear of everything.
#pragma once

#include "hierarchy/model_file.h"
#include "path/camera_path.h"

#include <optional>

namespace gnomon::path {

/// What is asked of a walk.
struct WalkOptions {
    std::optional<int> storey;       // only there, counted from the lowest, 0; everywhere where not said
    std::optional<double> eyeHeight; // over the floor, world units, above 0; else 1.7 where metres fit, or a guess
};

/// A walk on the floors of `model`, in upright space (hierarchy/upright_frame.h) and in its unit, at 1.4 m/s (of an eye
/// at 1.7) for at most a minute, looking ahead along the way. Floors are found in voxels (Mononen 2009); all stays
/// clear of the eye by 0.15 m and the body passes below ceilings, between walls and over steps as people do. Of a model
/// larger than 80 m it takes the part that has the most floor under ceilings and beside things. A model that is too
/// small for metres and has no floor is a thing that stands on a ground: the walk leads around it there. Throws Error
/// where there is no floor, or no such storey.
CameraPath walk(const hierarchy::ModelFile& model, const WalkOptions& options);

} // namespace gnomon::path
