// Random points in a box, from the same random numbers on each machine.
#pragma once

#include "core/box.h"
#include "core/random.h"

namespace gnomon {

/// Returns a random point of `box`.
inline glm::dvec3 randomPoint(Random& random, const Box& box) {
    glm::dvec3 point(0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        point[axis] = random.uniform(box.min[axis], box.max[axis]);
    return point;
}

/// Returns a random point of the cube from -`reach` to `reach` in each axis.
inline glm::dvec3 randomPoint(Random& random, double reach) {
    return randomPoint(random, Box{glm::dvec3(-reach), glm::dvec3(reach)});
}

} // namespace gnomon
