// Light directions to sample the theory's figures at.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::theory {

constexpr double kDegree = 0.017453292519943295; // radians

/// A square grid over the disc of light directions above the viewer, as seen from overhead.
std::vector<glm::dvec3> hemisphereGrid();

/// `count` directions spread evenly over the hemisphere above the viewer.
std::vector<glm::dvec3> evenHemisphere(int count);

} // namespace gnomon::theory
