// Models for tests of paths: written, built, and with their finest triangles in memory.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/read/open_mesh_sources.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <unistd.h>

namespace gnomon::path {

/// Returns a function that writes the model of `gnomon make`.
inline auto made(const std::string& kind, std::uint64_t triangles) {
    return [=](const std::string& path) {
        NoProgress progress;
        make::writeMadeModel(*make::makeNamedModel(kind, triangles, 1), path, "made", 0, progress);
    };
}

/// Returns the distance from `point` to the nearest of `triangles`, at most `maxDistance`.
inline double clearanceOf(
    const std::vector<std::array<glm::dvec3, 3>>& triangles, const glm::dvec3& point, double maxDistance) {
    double square = maxDistance * maxDistance;
    for (const std::array<glm::dvec3, 3>& t : triangles) {
        const glm::dvec3 below = glm::min(glm::min(t[0], t[1]), t[2]) - maxDistance;
        const glm::dvec3 above = glm::max(glm::max(t[0], t[1]), t[2]) + maxDistance;
        if (glm::any(glm::lessThan(point, below)) || glm::any(glm::greaterThan(point, above))) continue;
        square = std::min(square, proximity::distanceToTriangle(point, t[0], t[1], t[2]).square);
    }
    return std::sqrt(square);
}

/// A built model from the mesh that `write(path)` writes, with its finest triangles in world space.
class MadeModel {
public:
    template <class Write>
    explicit MadeModel(const Write& write, pipeline::BuildOptions options = {}) {
        const std::string stem =
            (std::filesystem::temp_directory_path() / ("gnomon_path_test_" + std::to_string(::getpid()))).string();
        write(stem + ".ply");
        NoProgress progress;
        options.output = stem + ".gnm";
        if (!options.up) options.up = hierarchy::UpAxis(); // a guess can be wrong for boxes
        const auto source = read::openMeshSources({stem + ".ply"}, gibibytes(1));
        pipeline::buildModel(*source, options, progress);
        file_ = std::make_unique<hierarchy::ModelFile>(stem + ".gnm");
        std::filesystem::remove(stem + ".ply");
        std::filesystem::remove(stem + ".gnm"); // the open file stays readable
        readTriangles();
    }

    const hierarchy::ModelFile& file() const { return *file_; }

    /// Returns the distance from `point` to the nearest triangle, at most `maxDistance`.
    double clearance(const glm::dvec3& point, double maxDistance) const {
        return clearanceOf(triangles_, point, maxDistance);
    }

    /// Returns the distances of all intersections of the ray from `origin` along the unit vector `direction`, nearest
    /// first.
    std::vector<double> met(const glm::dvec3& origin, const glm::dvec3& direction) const {
        std::vector<double> distances;
        for (const std::array<glm::dvec3, 3>& t : triangles_) {
            const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
            const double distance = glm::dot(t[0] - origin, normal) / glm::dot(direction, normal);
            if (!(distance >= 0)) continue;
            const glm::dvec3 at = origin + distance * direction;
            if (proximity::distanceToTriangle(at, t[0], t[1], t[2]).square <= 1e-20 * distance * distance)
                distances.push_back(distance);
        }
        std::sort(distances.begin(), distances.end());
        return distances;
    }

    const std::vector<std::array<glm::dvec3, 3>>& triangles() const { return triangles_; }

private:
    void readTriangles() {
        const hierarchy::Grid& grid = file_->summary().grid;
        for (std::uint32_t id = 0; id < file_->pages().size(); ++id) {
            if (file_->pages()[id].level != 0) continue;
            const hierarchy::Page page = file_->readPage(id);
            for (const hierarchy::Cluster& cluster : page.clusters)
                for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
                    std::array<glm::dvec3, 3>& corners = triangles_.emplace_back();
                    for (std::size_t i = 0; i < 3; ++i) {
                        const std::uint8_t corner = page.triangles[cluster.firstTriangle + t][i];
                        corners[i] = grid.world(page.vertices[cluster.firstVertex + corner].position);
                    }
                }
        }
    }

    std::unique_ptr<hierarchy::ModelFile> file_;
    std::vector<std::array<glm::dvec3, 3>> triangles_;
};

} // namespace gnomon::path
