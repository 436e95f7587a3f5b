// Ray tracing trees that are reused between frames. Each run of clusters of a page that cuts draw together has a tree,
// built when a frame first draws it. Each frame builds a tree over its runs.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"
#include "raytrace/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::raytrace {

/// Adjacent clusters of a resident page.
struct PageClusters {
    std::uint32_t page = 0; // page id
    ClusterSpan span;
};

/// A triangle of a resident page: the index of the cluster in the page, and of the triangle in the cluster.
struct PageTriangle {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    std::uint32_t triangle = 0;
};

/// Returns the approximate memory of a page's trees. On models of many kinds the estimate is never too small, and at
/// most a third too large.
Bytes keptTreeBytes(const hierarchy::PageInfo& page);

/// The trees of a model's pages. Only one thread at a time may use them.
class KeptTrees {
public:
    KeptTrees();
    ~KeptTrees();
    KeptTrees(const KeptTrees&) = delete;
    KeptTrees& operator=(const KeptTrees&) = delete;
    KeptTrees(KeptTrees&&) = delete;
    KeptTrees& operator=(KeptTrees&&) = delete;

    /// Removes the trees of `page`. Afterwards, no CutScene that contains clusters of the page may be queried.
    void drop(std::uint32_t page);

    /// Returns the memory that Embree uses for the trees.
    Bytes bytes() const;

private:
    friend class CutScene;
    struct State;
    std::unique_ptr<State> state_;
};

/// The rule for a ray that hits a triangle.
class HitRule {
public:
    HitRule() = default;
    virtual ~HitRule() = default;
    HitRule(const HitRule&) = delete;
    HitRule& operator=(const HitRule&) = delete;
    HitRule(HitRule&&) = delete;
    HitRule& operator=(HitRule&&) = delete;

    /// Returns true if `triangle`, a hit of ray `ray` in float arithmetic, stops the ray. Can run on any thread.
    virtual bool stops(std::uint32_t ray, const PageTriangle& triangle) const = 0;
};

/// The clusters of a frame's cut as a scene for rays. Many threads may query it at once while the trees of its pages
/// exist.
class CutScene final : public Occluders {
public:
    /// Builds a scene of `clusters`, which may overlap, relative to `origin`. It builds missing trees on all cores: 0.2
    /// microseconds and 90 to 145 bytes per triangle. Corners within a run are exactly on the grid. The position of a
    /// run has float precision. Throws Error if Embree fails.
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

    /// Returns true if a triangle is on `ray`. The ray is in world units, relative to the scene's origin.
    bool isOccluded(const Ray& ray) const override;

    /// Returns true if a triangle stops `ray` according to `rule`. The ray is in cells relative to the scene's origin,
    /// and `name` identifies it to the rule.
    bool isStopped(const Ray& ray, std::uint32_t name, const HitRule& rule) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::raytrace
