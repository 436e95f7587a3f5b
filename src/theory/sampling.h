// Light directions at which the figures of the theory are sampled.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::theory {

constexpr double kDegree = 0.017453292519943295; // radians

/// Returns a square grid over the disc of light directions above the viewer, seen from above.
std::vector<glm::dvec3> hemisphereGrid();

/// Returns `count` directions, spread evenly over the hemisphere above the viewer.
std::vector<glm::dvec3> evenHemisphere(int count);

} // namespace gnomon::theory
