#include "raytrace/kept_trees.h"

#include "raytrace/embree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bitset>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace gnomon::raytrace {

namespace {

/// Max number of clusters with a common ray-tracing tree. Groups rarely have more clusters.
constexpr std::uint32_t kMaxClusters = 64;

using ClusterBits = std::bitset<kMaxClusters>;

/// A range of clusters with a common ray-tracing tree (a run): adjacent clusters of one group with the same refinement.
/// A cut draws all of them or none, except clusters outside its volumes.
struct Run {
    std::uint32_t firstCluster = 0;
    std::uint32_t clusterCount = 0;
    // Min corner of the run's bounding box. It is the origin of the run's Embree scene, whose unit is a grid cell.
    hierarchy::GridPoint corner{};
    RTCScene scene = nullptr;        // ray-tracing tree; null until a frame draws the run
    std::vector<std::uint32_t> ends; // per cluster, the index after its last triangle in the run
    ClusterBits drawn;               // clusters of the run that the current frame draws
};

/// The ranges of clusters of a page that have a common ray-tracing tree each (runs).
struct PageRuns {
    explicit PageRuns(const hierarchy::Page& page);
    ~PageRuns();
    PageRuns(const PageRuns&) = delete;
    PageRuns& operator=(const PageRuns&) = delete;
    PageRuns(PageRuns&&) = delete;
    PageRuns& operator=(PageRuns&&) = delete;

    std::vector<Run> runs;
    std::vector<std::uint32_t> runOfCluster;
};

PageRuns::PageRuns(const hierarchy::Page& page) : runOfCluster(page.clusters.size()) {
    for (const hierarchy::Group& group : page.groups)
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            const bool continues = c > group.firstCluster && runs.back().clusterCount < kMaxClusters &&
                                   page.clusters[c].refinement == page.clusters[c - 1].refinement;
            if (!continues) runs.emplace_back().firstCluster = c;
            ++runs.back().clusterCount;
            runOfCluster[c] = static_cast<std::uint32_t>(runs.size() - 1);
        }
}

PageRuns::~PageRuns() {
    for (const Run& run : runs)
        if (run.scene != nullptr) rtcReleaseScene(run.scene);
}

/// A range of clusters with a common tree (a run) of which a frame draws at least one cluster.
struct DrawnRun {
    std::uint32_t page = 0;
    std::uint32_t firstCluster = 0;
    const std::vector<std::uint32_t>* ends = nullptr; // from the run
    ClusterBits drawn;
};

/// The data of a ray query for Embree's hit filter. Embree passes the address of the member `base`.
struct RayContext {
    RTCIntersectContext base{};
    const DrawnRun* runs = nullptr; // one per Embree instance
    const HitRule* rule = nullptr;
    std::uint32_t name = 0;
};

/// Rejects hits on clusters that the frame does not draw, and hits that do not stop the ray according to the hit rule.
void filterHit(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const RayContext*>(arguments->context);
    const DrawnRun& run = context.runs[RTCHitN_instID(arguments->hit, arguments->N, 0, 0)];
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    const std::vector<std::uint32_t>& ends = *run.ends;
    const auto cluster =
        static_cast<std::uint32_t>(std::upper_bound(ends.begin(), ends.end(), triangle) - ends.begin());
    const std::uint32_t first = cluster == 0 ? 0 : ends[cluster - 1];
    const bool isStopped =
        run.drawn[cluster] &&
        (context.rule == nullptr ||
         context.rule->stops(context.name, {run.page, run.firstCluster + cluster, triangle - first}));
    if (!isStopped) *arguments->valid = 0;
}

/// Copies the triangles of `run` into an Embree geometry of `scene`. Positions are relative to the corner of the run.
void addTriangles(RTCDevice device, const hierarchy::Page& page, RTCScene scene, Run& run) {
    hierarchy::GridBox box;
    std::uint32_t vertices = 0;
    std::uint32_t triangles = 0;
    run.ends.clear();
    for (std::uint32_t c = run.firstCluster; c < run.firstCluster + run.clusterCount; ++c) {
        box.add(page.clusters[c].box);
        vertices += page.clusters[c].vertexCount;
        triangles += page.clusters[c].triangleCount;
        run.ends.push_back(triangles);
    }
    run.corner = box.min;
    const TriangleGeometry filled = newTriangles(device, vertices, triangles);
    float* positions = filled.positions;
    std::uint32_t* indices = filled.indices;
    std::uint32_t firstVertex = 0;
    for (std::uint32_t c = run.firstCluster; c < run.firstCluster + run.clusterCount; ++c) {
        const hierarchy::Cluster& cluster = page.clusters[c];
        for (std::uint32_t v = cluster.firstVertex; v < cluster.firstVertex + cluster.vertexCount; ++v) {
            const hierarchy::GridPoint& p = page.vertices[v].position;
            for (const std::uint32_t cells : {p.x - box.min.x, p.y - box.min.y, p.z - box.min.z})
                *positions++ = static_cast<float>(cells);
        }
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t)
            for (const std::uint8_t corner : page.triangles[t])
                *indices++ = firstVertex + corner;
        firstVertex += cluster.vertexCount;
    }
    rtcSetGeometryOccludedFilterFunction(filled.geometry, &filterHit);
    attachTriangles(scene, filled);
}

void build(RTCDevice device, const hierarchy::Page& page, Run& run) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    addTriangles(device, page, scene, run);
    rtcCommitScene(scene);
    requireNoError(device, "building the acceleration structure");
    run.scene = scene;
}

/// Adds the tree of `run` to the top-level scene `scene` as an instance, translated to the run's position relative to
/// `origin`.
void attach(RTCDevice device, RTCScene scene, const Run& run, const hierarchy::GridPoint& origin) {
    const auto cells = [](std::uint32_t to, std::uint32_t from) {
        return static_cast<float>(static_cast<std::int64_t>(to) - static_cast<std::int64_t>(from));
    };
    const std::array<float, 12> place = {
        1,
        0,
        0,
        0,
        1,
        0,
        0,
        0,
        1,
        cells(run.corner.x, origin.x),
        cells(run.corner.y, origin.y),
        cells(run.corner.z, origin.z)};
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, run.scene);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, place.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometry(scene, instance);
    rtcReleaseGeometry(instance);
}

bool countBytes(void* to, ssize_t change, bool /*isAfter*/) {
    static_cast<std::atomic<std::int64_t>*>(to)->fetch_add(change, std::memory_order_relaxed);
    return true;
}

} // namespace

struct KeptTrees::State {
    State() : device(newDevice()) { rtcSetDeviceMemoryMonitorFunction(device, &countBytes, &bytes); }

    ~State() {
        pages.clear();
        rtcReleaseDevice(device);
    }

    State(const State&) = delete;
    State& operator=(const State&) = delete;
    State(State&&) = delete;
    State& operator=(State&&) = delete;

    std::atomic<std::int64_t> bytes{0};
    RTCDevice device = nullptr;
    std::unordered_map<std::uint32_t, PageRuns> pages;
};

Bytes keptTreeBytes(const hierarchy::PageInfo& page) {
    // Memory was measured with SSE2 and AVX-512: 88 bytes per triangle and 6,000 bytes per run. The numbers of runs per
    // page vary.
    constexpr std::uint64_t kBytesPerTriangle = 96;
    constexpr std::uint64_t kBytesPerCluster = 3072;
    constexpr std::uint64_t kBytesPerPage = 16384;
    return {page.triangleCount * kBytesPerTriangle + page.clusterCount * kBytesPerCluster + kBytesPerPage};
}

KeptTrees::KeptTrees() : state_(std::make_unique<State>()) {}

KeptTrees::~KeptTrees() = default;

void KeptTrees::drop(std::uint32_t page) {
    state_->pages.erase(page);
}

Bytes KeptTrees::bytes() const {
    return {static_cast<std::uint64_t>(std::max<std::int64_t>(state_->bytes.load(std::memory_order_relaxed), 0))};
}

struct CutScene::State {
    explicit State(RTCDevice device) : scene(rtcNewScene(device)) {}

    ~State() { rtcReleaseScene(scene); }

    State(const State&) = delete;
    State& operator=(const State&) = delete;
    State(State&&) = delete;
    State& operator=(State&&) = delete;

    RTCScene scene = nullptr;
    std::vector<DrawnRun> runs; // in the order of Embree's instance numbers
    double cellsPerUnit = 1;
};

namespace {

/// A range of clusters with a common ray-tracing tree (a run), and its page.
struct FoundRun {
    const PageClusters* clusters = nullptr;
    Run* run = nullptr;
};

/// Returns the runs (ranges with a common tree) that contain `clusters`, each run once. Also marks the drawn clusters
/// of each run.
std::vector<FoundRun> foundRuns(
    std::unordered_map<std::uint32_t, PageRuns>& pages, std::span<const PageClusters> clusters) {
    std::vector<FoundRun> found;
    PageRuns* page = nullptr;
    for (const PageClusters& range : clusters) {
        if (page == nullptr || (&range)[-1].page != range.page)
            page = &pages.try_emplace(range.page, *range.span.page).first->second;
        for (std::uint32_t c = range.span.firstCluster; c < range.span.firstCluster + range.span.clusterCount; ++c) {
            Run& run = page->runs[page->runOfCluster[c]];
            if (run.drawn.none()) found.push_back({&range, &run});
            run.drawn.set(c - run.firstCluster);
        }
    }
    return found;
}

} // namespace

CutScene::CutScene(
    KeptTrees& trees,
    std::span<const PageClusters> clusters,
    const hierarchy::Grid& grid,
    const hierarchy::GridPoint& origin)
    : state_(std::make_unique<State>(trees.state_->device)) {
    RTCDevice device = trees.state_->device;
    state_->cellsPerUnit = std::ldexp(1.0, -grid.stepExponent);
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    const std::vector<FoundRun> found = foundRuns(trees.state_->pages, clusters);
    for (const FoundRun& each : found) {
        state_->runs.push_back({each.clusters->page, each.run->firstCluster, &each.run->ends, each.run->drawn});
        each.run->drawn.reset();
    }
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
        if (found[i].run->scene == nullptr) build(device, *found[i].clusters->span.page, *found[i].run);
    });
    for (const FoundRun& each : found)
        attach(device, state_->scene, *each.run, origin);
    rtcCommitScene(state_->scene);
    requireNoError(device, "building the acceleration structure");
}

CutScene::~CutScene() = default;
CutScene::CutScene(CutScene&& other) noexcept = default;
CutScene& CutScene::operator=(CutScene&& other) noexcept = default;

namespace {

bool isOnRay(RTCScene scene, RayContext& context, const Ray& ray) {
    rtcInitIntersectContext(&context.base);
    RTCRay found = embreeRay(ray);
    rtcOccluded1(scene, &context.base, &found);
    return found.tfar < 0;
}

} // namespace

bool CutScene::isOccluded(const Ray& ray) const {
    Ray inCells = ray;
    inCells.origin = glm::vec3(glm::dvec3(ray.origin) * state_->cellsPerUnit);
    inCells.tMin = static_cast<float>(static_cast<double>(ray.tMin) * state_->cellsPerUnit);
    inCells.tMax = static_cast<float>(static_cast<double>(ray.tMax) * state_->cellsPerUnit);
    RayContext context{.runs = state_->runs.data()};
    return isOnRay(state_->scene, context, inCells);
}

bool CutScene::isStopped(const Ray& ray, std::uint32_t name, const HitRule& rule) const {
    RayContext context{.runs = state_->runs.data(), .rule = &rule, .name = name};
    return isOnRay(state_->scene, context, ray);
}

} // namespace gnomon::raytrace
