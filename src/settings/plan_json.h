// A frame's plan as a JSON document and as text: what `gnomon explain` prints.
#pragma once

#include "plan/frame_plan.h"
#include "settings/backend_choice.h"

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::settings {

/// Returns the JSON document of `gnomon explain`: the plan, and the backend that it is for. Matrices and planes are in
/// world space: a plane (x, y, z, offset) contains the points whose product with (point, 1) is at least 0.
nlohmann::ordered_json planJson(const plan::FramePlan& plan, const BackendChoice& backend);

/// Returns the same as text.
std::string planText(const plan::FramePlan& plan, const BackendChoice& backend);

} // namespace gnomon::settings
