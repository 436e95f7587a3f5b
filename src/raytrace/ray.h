// A ray, and the interface of a scene for occlusion queries.
#pragma once

#include <glm/vec3.hpp>

#include <limits>

namespace gnomon::raytrace {

/// A ray. Positions are relative to the eye or to another near origin, so that floats are precise there.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};
    float tMin = 0; // min parameter of a hit along `direction`
    float tMax = std::numeric_limits<float>::infinity();
};

/// A set of triangles for occlusion queries, in world axes and units. Many threads may query it at once.
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

} // namespace gnomon::raytrace
