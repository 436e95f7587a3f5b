// Prints the plan of a frame as JSON or as text, for `gnomon explain`. The plan contains the passes and their shadow
// maps.
#pragma once

#include "plan/frame_plan.h"
#include "settings/backend_choice.h"

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::settings {

/// Returns the JSON document that `gnomon explain` prints: the plan of a frame and its backend. Matrices and planes are
/// in world space. A matrix has 16 numbers, row by row. A point p is inside a plane (x, y, z, offset) if dot((x, y, z),
/// p) + offset >= 0.
nlohmann::ordered_json planJson(const plan::FramePlan& plan, const BackendChoice& backend);

/// Returns a readable text about the plan of a frame and its backend.
std::string planText(const plan::FramePlan& plan, const BackendChoice& backend);

} // namespace gnomon::settings
