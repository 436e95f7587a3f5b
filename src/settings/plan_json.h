// The output of `gnomon explain`: the plan of a frame as JSON or as text.
#pragma once

#include "plan/frame_plan.h"
#include "settings/backend_choice.h"

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::settings {

/// Returns the JSON document of `gnomon explain`: the plan and its backend. Matrices and planes are in world space. A
/// matrix has 16 numbers, row by row. A point p is inside a plane (x, y, z, offset) if dot((x, y, z), p) + offset >= 0.
nlohmann::ordered_json planJson(const plan::FramePlan& plan, const BackendChoice& backend);

/// Returns the plan and its backend as text for people.
std::string planText(const plan::FramePlan& plan, const BackendChoice& backend);

} // namespace gnomon::settings
