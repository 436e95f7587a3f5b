// Trees of rays that are kept from frame to frame: one over each run of a page's clusters that cuts draw together, made
// when a frame first draws it, and a tree over the runs that a frame draws.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"
#include "raycast/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::raycast {

/// Neighbouring clusters of a resident page.
struct PageClusters {
    std::uint32_t page = 0; // its id
    ClusterSpan span;
};

/// A triangle of a resident page: the cluster's index there, the triangle's in the cluster.
struct PageTriangle {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    std::uint32_t triangle = 0;
};

/// What the trees of a page take, about: no less on models of many kinds, at most a third more.
Bytes keptTreeBytes(const hierarchy::PageInfo& page);

/// The trees of a model's pages. One thread at a time.
class KeptTrees {
public:
    KeptTrees();
    ~KeptTrees();
    KeptTrees(const KeptTrees&) = delete;
    KeptTrees& operator=(const KeptTrees&) = delete;
    KeptTrees(KeptTrees&&) = delete;
    KeptTrees& operator=(KeptTrees&&) = delete;

    /// Forgets what was made of `page`; no CutScene that holds clusters of it may be asked any more.
    void drop(std::uint32_t page);

    /// Forgets all pages.
    void dropAll();

    /// What Embree holds for the trees.
    Bytes bytes() const;

private:
    friend class CutScene;
    struct State;
    std::unique_ptr<State> state_;
};

/// What a ray does about a triangle on it.
class HitRule {
public:
    HitRule() = default;
    virtual ~HitRule() = default;
    HitRule(const HitRule&) = delete;
    HitRule& operator=(const HitRule&) = delete;
    HitRule(HitRule&&) = delete;
    HitRule& operator=(HitRule&&) = delete;

    /// Whether `triangle`, as floats see it on ray `ray`, stops that. From any thread.
    virtual bool stops(std::uint32_t ray, const PageTriangle& triangle) const = 0;
};

/// The clusters of a frame's cut, as rays see them. Its queries may come from many threads at once, as long as its
/// pages' trees are kept.
class CutScene final : public Occluders {
public:
    /// Over `clusters`, which may overlap, relative to `origin`; makes the trees that are not there yet, on all cores:
    /// 0.2 microseconds and 90 to 145 bytes a triangle. Within a run, corners are on the grid to the bit; runs lie
    /// where they are as well as floats know it. Throws Error if Embree fails.
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

    /// Of a ray in world units from the grid point that the scene is relative to.
    bool isOccluded(const Ray& ray) const override;

    /// Of a ray in cells from there: whether a triangle is on it that stops it by `rule`, which knows it as `name`.
    bool isStopped(const Ray& ray, std::uint32_t name, const HitRule& rule) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::raycast
