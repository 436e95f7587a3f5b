// A ray, and what may be asked whether anything is on it.
#pragma once

#include <glm/vec3.hpp>

#include <limits>

namespace gnomon::raycast {

/// A ray; points are relative to the eye or an origin near it, so that floats lose nothing there.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};
    float least = 0; // of the parameter along `direction`
    float greatest = std::numeric_limits<float>::infinity();
};

/// Triangles that rays in world orientation and units may be asked about, from many threads at once.
class Occluders {
public:
    Occluders() = default;
    virtual ~Occluders() = default;
    Occluders(const Occluders&) = delete;
    Occluders& operator=(const Occluders&) = delete;
    Occluders(Occluders&&) noexcept = default;
    Occluders& operator=(Occluders&&) noexcept = default;

    virtual bool isOccluded(const Ray& ray) const = 0;
};

} // namespace gnomon::raycast
