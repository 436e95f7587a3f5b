// A frame's plan as a JSON document and as text: what `gnomon explain` prints.
#pragma once

#include "plan/frame_plan.h"

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::settings {

/// The document that CONTRACT.md lays down. Matrices and planes are in world space: a plane (x, y, z, offset) holds
/// what has a product of at least 0 with (point, 1).
nlohmann::ordered_json planJson(const plan::FramePlan& plan);

/// The same for a reader.
std::string planText(const plan::FramePlan& plan);

} // namespace gnomon::settings
