// A ray-tracing scene of given clusters, relative to the eye. It finds the first hit of a ray, or tests whether a ray
// is occluded.
#pragma once

#include "core/convex_volume.h"
#include "core/units.h"
#include "hierarchy/page.h"
#include "raytrace/ray.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::raytrace {

/// A range of adjacent clusters of one decoded page.
struct ClusterSpan {
    const hierarchy::Page* page = nullptr;
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
};

/// The first triangle that a ray hits.
struct Hit {
    float distance = 0;         // parameter of the hit along the ray's direction
    std::uint32_t span = 0;     // index of the ClusterSpan in the argument of the constructor
    std::uint32_t cluster = 0;  // index of the cluster in its page
    std::uint32_t triangle = 0; // index of the triangle in its page
    float u = 0;                // barycentric coordinates: the hit is (1 - u - v) a + u b + v c
    float v = 0;
    glm::vec3 normal{0}; // geometric, unit length, towards the ray's origin
};

/// Returns the part of `ray` that is on the inner side of all `planes`, or nullopt if no part is.
std::optional<Ray> keptPart(Ray ray, std::span<const Plane> planes);

/// Max memory of a ray-tracing scene during its construction, per triangle.
inline constexpr Bytes kSceneBytesPerTriangle{83};

/// An Embree scene of one mesh, for rays relative to the eye. Many threads may query it at once.
class Scene final : public Occluders {
public:
    /// Builds a ray-tracing scene from copies of the triangles of `spans`, relative to `eye` (local space). Both sides
    /// of triangles are hit. This takes about 63 bytes and 0.25 microseconds per triangle. The pages may be evicted
    /// afterwards. Throws Error if Embree fails.
    Scene(std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& eye);
    ~Scene() override;
    Scene(Scene&& other) noexcept;
    Scene& operator=(Scene&& other) noexcept;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    std::uint64_t triangleCount() const;

    /// Restricts later first-hit queries to the inner side of all `planes` (relative to the eye), as if the triangles
    /// had been cut there. Occlusion queries are restricted only if `cutsOccluders` is true; otherwise they use whole
    /// triangles.
    void cutBy(std::vector<Plane> planes, bool cutsOccluders);

    std::optional<Hit> firstHit(const Ray& ray) const;

    bool isOccluded(const Ray& ray) const override;

    /// Returns 1 for each ray that hits a triangle, else 0. Runs on all cores.
    std::vector<std::uint8_t> occlusion(std::span<const Ray> rays) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::raytrace
