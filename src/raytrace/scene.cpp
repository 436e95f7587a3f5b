#include "raytrace/scene.h"

#include "raytrace/embree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace gnomon::raytrace {
namespace {

/// Number of rays per parallel task.
constexpr std::size_t kRaysPerTask = 1024;

template <class Body>
void forAllRays(std::size_t count, const Body& body) {
    tbb::parallel_for(std::size_t{0}, (count + kRaysPerTask - 1) / kRaysPerTask, [&](std::size_t task) {
        const std::size_t end = std::min(count, (task + 1) * kRaysPerTask);
        for (std::size_t i = task * kRaysPerTask; i < end; ++i)
            body(i);
    });
}

} // namespace

struct Scene::State {
    /// The first triangle of a cluster in the Embree scene, and the origin of the cluster.
    struct Origin {
        std::uint32_t firstTriangle = 0;
        std::uint32_t span = 0;
        std::uint32_t cluster = 0;
        std::uint32_t firstInPage = 0;
    };

    State() : device(newDevice()), scene(rtcNewScene(device)) {}

    ~State() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    State(const State&) = delete;
    State& operator=(const State&) = delete;
    State(State&&) = delete;
    State& operator=(State&&) = delete;

    void addTriangles(std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& eye);
    void count(std::span<const ClusterSpan> spans);

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<Origin> origins;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::vector<Plane> planes; // section planes of `cutBy`; hits outside them do not count
    bool cutsOccluders = false;
};

std::optional<Ray> keptPart(Ray ray, std::span<const Plane> planes) {
    for (const Plane& plane : planes) {
        const double distance = plane.signedDistance(ray.origin);
        const double slope = glm::dot(plane.normal, glm::dvec3(ray.direction));
        const auto crossing = static_cast<float>(-distance / slope);
        if (slope > 0)
            ray.tMin = std::max(ray.tMin, crossing);
        else if (slope < 0)
            ray.tMax = std::min(ray.tMax, crossing);
        else if (distance < 0)
            return std::nullopt;
    }
    return ray.tMin <= ray.tMax ? std::optional(ray) : std::nullopt;
}

void Scene::State::count(std::span<const ClusterSpan> spans) {
    for (std::uint32_t s = 0; s < spans.size(); ++s) {
        for (std::uint32_t i = 0; i < spans[s].clusterCount; ++i) {
            const std::uint32_t index = spans[s].firstCluster + i;
            const hierarchy::Cluster& cluster = spans[s].page->clusters[index];
            origins.push_back({static_cast<std::uint32_t>(triangles), s, index, cluster.firstTriangle});
            triangles += cluster.triangleCount;
            vertices += cluster.vertexCount;
        }
    }
    if (triangles > 0xFFFFFFF0U || vertices > 0xFFFFFFF0U)
        throw Error("ray tracing", "too many triangles for one scene", "below 2^32", std::to_string(triangles));
}

void Scene::State::addTriangles(
    std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& eye) {
    const TriangleGeometry filled = newTriangles(device, vertices, triangles);
    float* positions = filled.positions;
    std::uint32_t* indices = filled.indices;
    std::uint32_t firstVertex = 0;
    for (const Origin& origin : origins) {
        const hierarchy::Page& page = *spans[origin.span].page;
        const hierarchy::Cluster& cluster = page.clusters[origin.cluster];
        for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
            const glm::dvec3 point = grid.local(page.vertices[cluster.firstVertex + v].position) - eye;
            for (int axis = 0; axis < 3; ++axis)
                *positions++ = static_cast<float>(point[axis]);
        }
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
            for (const std::uint8_t corner : page.triangles[cluster.firstTriangle + t])
                *indices++ = firstVertex + corner;
        firstVertex += cluster.vertexCount;
    }
    attachTriangles(scene, filled);
}

Scene::Scene(std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& eye)
    : state_(std::make_unique<State>()) {
    state_->count(spans);
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    if (state_->triangles > 0) state_->addTriangles(spans, grid, eye);
    rtcCommitScene(state_->scene);
    requireNoError(state_->device, "building the acceleration structure");
}

Scene::~Scene() = default;
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;

std::uint64_t Scene::triangleCount() const {
    return state_->triangles;
}

void Scene::cutBy(std::vector<Plane> planes, bool cutsOccluders) {
    state_->planes = std::move(planes);
    state_->cutsOccluders = cutsOccluders;
}

std::optional<Hit> Scene::firstHit(const Ray& ray) const {
    const std::optional<Ray> kept = keptPart(ray, state_->planes);
    if (!kept) return std::nullopt;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    RTCRayHit found{};
    found.ray = embreeRay(*kept);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const auto after = std::upper_bound(
        state_->origins.begin(),
        state_->origins.end(),
        found.hit.primID,
        [](std::uint32_t triangle, const State::Origin& origin) { return triangle < origin.firstTriangle; });
    const State::Origin& origin = *(after - 1);
    Hit hit;
    hit.distance = found.ray.tfar;
    hit.span = origin.span;
    hit.cluster = origin.cluster;
    hit.triangle = origin.firstInPage + (found.hit.primID - origin.firstTriangle);
    hit.u = found.hit.u;
    hit.v = found.hit.v;
    hit.normal = glm::normalize(glm::vec3(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z));
    if (glm::dot(hit.normal, ray.direction) > 0) hit.normal = -hit.normal;
    return hit;
}

bool Scene::isOccluded(const Ray& ray) const {
    const std::optional<Ray> kept = state_->cutsOccluders ? keptPart(ray, state_->planes) : ray;
    if (!kept) return false;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    RTCRay found = embreeRay(*kept);
    rtcOccluded1(state_->scene, &context, &found);
    return found.tfar < 0;
}

std::vector<std::uint8_t> Scene::occlusion(std::span<const Ray> rays) const {
    std::vector<std::uint8_t> result(rays.size());
    forAllRays(rays.size(), [&](std::size_t i) { result[i] = isOccluded(rays[i]) ? 1 : 0; });
    return result;
}

} // namespace gnomon::raytrace
