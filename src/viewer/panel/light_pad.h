// The pad on which the light is dragged: the hemisphere of lights, coloured by the storage factor of each.
#pragma once

#include "frame/renderer.h"
#include "viewer/panel/storage_pad.h"

namespace gnomon::viewer {

/// Describes the pad for Dear ImGui; true if `towardsLight` was dragged. `frame` says for which depth range and scheme.
bool drawLightPad(const frame::Frame* frame, const Camera& camera, StoragePad& pad, glm::dvec3& towardsLight);

} // namespace gnomon::viewer
