// Ray-tracing trees that are reused between frames. A run is a range of clusters of a page that cuts draw together.
// Each run has a tree, which is built when a frame first draws the run. Each frame builds a top-level tree over its
// runs.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"
#include "raytrace/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::raytrace {

/// A range of adjacent clusters of a resident page.
struct PageClusters {
    std::uint32_t page = 0; // page id
    ClusterSpan span;
};

/// A triangle of a resident page, identified by the index of its cluster in the page and its own index in the cluster.
struct PageTriangle {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    std::uint32_t triangle = 0;
};

/// Returns the approximate memory of the ray-tracing trees of a page. In tests with models of many kinds, the result
/// was never too small, and at most a third too large.
Bytes keptTreeBytes(const hierarchy::PageInfo& page);

/// The ray-tracing trees of a model's pages. Only one thread at a time may use them.
class KeptTrees {
public:
    KeptTrees();
    ~KeptTrees();
    KeptTrees(const KeptTrees&) = delete;
    KeptTrees& operator=(const KeptTrees&) = delete;
    KeptTrees(KeptTrees&&) = delete;
    KeptTrees& operator=(KeptTrees&&) = delete;

    /// Removes the trees of `page`. After this call, a CutScene that contains clusters of the page must not be queried.
    void drop(std::uint32_t page);

    /// Returns the memory that Embree uses for the trees.
    Bytes bytes() const;

private:
    friend class CutScene;
    struct State;
    std::unique_ptr<State> state_;
};

/// A rule that tells whether a triangle on a ray stops the ray.
class HitRule {
public:
    HitRule() = default;
    virtual ~HitRule() = default;
    HitRule(const HitRule&) = delete;
    HitRule& operator=(const HitRule&) = delete;
    HitRule(HitRule&&) = delete;
    HitRule& operator=(HitRule&&) = delete;

    /// Returns true if `triangle` stops ray `ray`. The triangle is a hit of the ray in float arithmetic. Can run on any
    /// thread.
    virtual bool stops(std::uint32_t ray, const PageTriangle& triangle) const = 0;
};

/// A ray-tracing scene of the clusters of a frame's cut. Many threads may query it at once, as long as the trees of its
/// pages exist.
class CutScene final : public Occluders {
public:
    /// Builds a scene of `clusters`, whose ranges may overlap, relative to `origin`. It builds missing trees on all
    /// cores. This takes 0.2 microseconds and 90 to 145 bytes per triangle. Corners are exactly on the grid relative to
    /// their run, and the position of a run has float precision. Throws Error if Embree fails.
    CutScene(
        KeptTrees& trees,
        std::span<const PageClusters> clusters,
        const hierarchy::Grid& grid,
        const hierarchy::GridPoint& origin);
    ~CutScene() override;
    CutScene(CutScene&& other) noexcept;
    CutScene& operator=(CutScene&& other) noexcept;
    CutScene(const CutScene&) = delete;
    CutScene& operator=(const CutScene&) = delete;

    /// Returns true if a triangle intersects `ray`, which is in world units relative to the scene's origin.
    bool isOccluded(const Ray& ray) const override;

    /// Returns true if a triangle stops `ray` according to `rule`. The ray is in grid cells relative to the scene's
    /// origin. `name` is the number of the ray that is passed to the rule.
    bool isStopped(const Ray& ray, std::uint32_t name, const HitRule& rule) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::raytrace
