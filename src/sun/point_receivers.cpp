#include "sun/point_receivers.h"

#include "core/error.h"
#include "exact/plain_shadows.h"
#include "render/exact_pass.h"
#include "sun/sectioned_cut.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::sun {

namespace {

constexpr std::size_t kHeld = raster::kMaxClusterTriangles; // points per receiver-only cluster
constexpr unsigned kTriangleBits = 8;
constexpr std::size_t kGrain = 16384;

hierarchy::GridBox boxOf(const exporter::CutMesh& mesh) {
    hierarchy::GridBox box;
    for (const hierarchy::Vertex& vertex : mesh.vertices)
        box.add(vertex.position);
    return box;
}

} // namespace

PointReceivers::PointReceivers(
    const exporter::UniformCut& cut, std::vector<glm::i64vec3> points, std::span<const Plane> sections)
    : points_(std::move(points)) {
    const hierarchy::GridBox box = boxOf(cut.mesh);
    for (int axis = 0; axis < 3; ++axis)
        origin_[axis] = (std::int64_t{(&box.min.x)[axis]} + (&box.max.x)[axis]) / 2;
    constexpr std::int64_t kFarthest = std::int64_t{1} << 30U;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        points_[i] -= origin_;
        const glm::i64vec3& p = points_[i];
        if (std::max({p.x, p.y, p.z}) > kFarthest || std::min({p.x, p.y, p.z}) < -kFarthest)
            throw Error(
                "point " + std::to_string(i + 1),
                "too far from the model",
                "at most 2^30 grid steps per axis from its centre",
                std::to_string(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})));
    }
    if (sections.empty())
        addCasters(cut);
    else
        addCasters(sectionedCut(cut, sections));
    addReceiverOnlyClusters();
}

void PointReceivers::addCasters(const exporter::UniformCut& cut) {
    positions_.reserve(cut.mesh.vertices.size() + points_.size());
    for (const hierarchy::Vertex& vertex : cut.mesh.vertices)
        positions_.push_back({vertex.position.x, vertex.position.y, vertex.position.z});
    triangles_.resize(cut.mesh.triangles.size());
    for (const exporter::CutCluster& cluster : cut.clusters) {
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t)
            for (std::size_t k = 0; k < 3; ++k)
                triangles_[t][k] = static_cast<std::uint8_t>(cut.mesh.triangles[t][k] - cluster.firstVertex);
        exact::Caster caster;
        caster.geometry = {
            positions_[cluster.firstVertex].data(),
            sizeof(Position),
            cluster.vertexCount,
            {&triangles_[cluster.firstTriangle], cluster.triangleCount},
            static_cast<std::uint32_t>(casters_.size()) << kTriangleBits};
        hierarchy::GridBox box;
        for (std::uint32_t v = cluster.firstVertex; v < cluster.firstVertex + cluster.vertexCount; ++v)
            box.add(cut.mesh.vertices[v].position);
        caster.min = glm::i64vec3(box.min.x, box.min.y, box.min.z) - origin_;
        caster.max = glm::i64vec3(box.max.x, box.max.y, box.max.z) - origin_;
        casters_.push_back(caster);
    }
    castersOfCut_ = casters_.size();
}

/// Adds clusters that contain only the tested points. Each point is a triangle without extent, which casts no shadow.
/// The samples refer to the corners of these triangles.
void PointReceivers::addReceiverOnlyClusters() {
    static const std::array<hierarchy::Triangle, kHeld> kPoints = [] {
        std::array<hierarchy::Triangle, kHeld> result{};
        for (std::size_t i = 0; i < kHeld; ++i)
            result[i].fill(static_cast<std::uint8_t>(i));
        return result;
    }();
    const std::size_t first = positions_.size();
    for (const glm::i64vec3& p : points_) {
        const glm::i64vec3 cell = p + origin_; // may overflow, because only differences from the origin are used
        positions_.push_back(
            {static_cast<std::uint32_t>(cell.x),
             static_cast<std::uint32_t>(cell.y),
             static_cast<std::uint32_t>(cell.z)});
    }
    for (std::size_t i = 0; i < points_.size(); i += kHeld) {
        const std::size_t held = std::min(kHeld, points_.size() - i);
        exact::Caster caster;
        caster.geometry = {
            positions_[first + i].data(),
            sizeof(Position),
            static_cast<std::uint32_t>(held),
            std::span(kPoints).first(held),
            static_cast<std::uint32_t>(casters_.size()) << kTriangleBits};
        caster.min = caster.max = points_[i];
        for (std::size_t k = i; k < i + held; ++k) {
            caster.min = glm::min(caster.min, points_[k]);
            caster.max = glm::max(caster.max, points_[k]);
        }
        casters_.push_back(caster);
    }
}

void PointReceivers::collect(const IntegerLight& light) {
    exact::SampleSpace space;
    space.light = light;
    space.shear = exact::shearAlong(light);
    exact::SampleList& samples = exact_.samples();
    samples.reset(space, points_.size());
    samples.append(points_.size());
    const exact::LightShear& shear = space.shear;
    const std::uint32_t tolerance = render::tolerance(light);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points_.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const glm::dvec3 p(points_[i]);
            samples.u[i] = p[shear.first] - shear.firstRatio * p[shear.along];
            samples.v[i] = p[shear.second] - shear.secondRatio * p[shear.along];
            samples.h[i] = shear.sign * p[shear.along];
            samples.pixel[i] = static_cast<std::uint32_t>(i);
            samples.triangle[i] = static_cast<std::uint32_t>((castersOfCut_ + i / kHeld) << kTriangleBits | i % kHeld);
            samples.second[i] = samples.third[i] = 0;
            samples.tolerance[i] = tolerance;
        }
    });
}

glm::uvec3 PointReceivers::originCell() const {
    return {
        static_cast<std::uint32_t>(origin_.x),
        static_cast<std::uint32_t>(origin_.y),
        static_cast<std::uint32_t>(origin_.z)};
}

void PointReceivers::resolvePlainly(
    const IntegerLight& light, std::span<const std::uint8_t> isRequested, std::span<std::uint8_t> isLit) {
    collect(light);
    const std::vector<std::uint8_t> statuses =
        exact::plainStatuses(exact_.samples(), casters_, originCell(), isRequested);
    for (std::size_t i = 0; i < points_.size(); ++i)
        isLit[i] = isRequested[i] != 0 && !exact::isDark(statuses[i]) ? 1 : 0;
}

exact::ExactStatistics PointReceivers::resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) {
    collect(light);
    constexpr int kSide = 512;
    const std::array planes = {glm::dmat3(1)}; // the light plane without a warp, because there is no near viewer
    const exact::ExactStatistics statistics =
        exact_.resolve({casters_, originCell(), planes, kSide, casters_.size() - castersOfCut_});
    const std::span<const std::uint8_t> statuses = exact_.statuses();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points_.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            isLit[i] = exact::isDark(statuses[i]) ? 0 : 1;
    });
    return statistics;
}

} // namespace gnomon::sun
