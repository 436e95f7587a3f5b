// The geometry of given clusters as rays see it: exact hits and exact occlusion, relative to the eye.
#pragma once

#include "core/convex_volume.h"
#include "core/units.h"
#include "hierarchy/page.h"
#include "raycast/ray.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::raycast {

/// Neighbouring clusters of one decoded page.
struct ClusterSpan {
    const hierarchy::Page* page = nullptr;
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
};

/// The first triangle on a ray.
struct Hit {
    float distance = 0;         // the parameter along the ray's direction
    std::uint32_t span = 0;     // index of the ClusterSpan that the scene was made of
    std::uint32_t cluster = 0;  // index in its page
    std::uint32_t triangle = 0; // index in its page
    float u = 0;                // barycentric: (1 - u - v) a + u b + v c
    float v = 0;
    glm::vec3 normal{0}; // geometric, unit length, towards the ray's origin
};

/// The part of `ray` on the inner side of all `planes`; nothing where there is none.
std::optional<Ray> keptPart(Ray ray, std::span<const Plane> planes);

/// What a scene takes at most while it is built, a triangle.
inline constexpr Bytes kSceneBytesPerTriangle{83};

/// An Embree scene of one mesh, for rays relative to the eye. Its queries may come from many threads at once.
class Scene final : public Occluders {
public:
    /// Copies the triangles of `spans`, each drawn two-sided, relative to `eye` (local space), and builds over them:
    /// about 63 bytes and a quarter of a microsecond a triangle. Pages may go afterwards. Throws Error if Embree fails.
    Scene(std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& eye);
    ~Scene() override;
    Scene(Scene&& other) noexcept;
    Scene& operator=(Scene&& other) noexcept;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    std::uint64_t triangleCount() const;

    /// From now on rays see only what lies on the inner side of all `planes`, relative to the eye, as if the triangles
    /// had been cut there; what is only asked for being in the way is whole unless `cutsOccluders`.
    void cutBy(std::vector<Plane> planes, bool cutsOccluders);

    std::optional<Hit> firstHit(const Ray& ray) const;

    bool isOccluded(const Ray& ray) const override;

    /// For each ray its first hit, on all cores.
    std::vector<std::optional<Hit>> firstHits(std::span<const Ray> rays) const;

    /// For each ray whether anything is on it, on all cores.
    std::vector<std::uint8_t> occlusion(std::span<const Ray> rays) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::raycast
