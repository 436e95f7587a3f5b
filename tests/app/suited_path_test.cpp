// The paths that `gnomon path` finds: where they lead, and that a walk passes through nothing.
#include "app/suited_path.h"
#include "core/error.h"
#include "culling/triangle_clip.h"
#include "preprocess/build/triangle_distance.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/read/open_mesh_sources.h"
#include "selection/error_rule.h"
#include "temporary_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::app {
namespace {

constexpr int kSamples = 400; // along a path

/// A made model, built; and its finest triangles, in world space.
class MadeModel {
public:
    MadeModel(const std::string& kind, std::uint64_t triangles) {
        const std::string stem =
            (std::filesystem::temp_directory_path() / ("gnomon_path_test_" + std::to_string(::getpid()))).string();
        NoProgress progress;
        preprocess::writeMadeModel(*preprocess::makeNamedModel(kind, triangles, 1), stem + ".ply", "made", 0, progress);
        preprocess::BuildOptions options;
        options.output = stem + ".gnm";
        const auto source = preprocess::openMeshSources({stem + ".ply"}, gibibytes(1));
        preprocess::buildModel(*source, options, progress);
        file_ = std::make_unique<hierarchy::ModelFile>(stem + ".gnm");
        std::filesystem::remove(stem + ".ply");
        std::filesystem::remove(stem + ".gnm"); // the open file stays readable
        readTriangles();
    }

    const hierarchy::ModelFile& file() const { return *file_; }

    /// The distance from `point` to the nearest triangle, up to `most`.
    double clearance(const glm::dvec3& point, double most) const {
        double square = most * most;
        for (const std::array<glm::dvec3, 3>& t : triangles_) {
            const glm::dvec3 below = glm::min(glm::min(t[0], t[1]), t[2]) - most;
            const glm::dvec3 above = glm::max(glm::max(t[0], t[1]), t[2]) + most;
            if (glm::any(glm::lessThan(point, below)) || glm::any(glm::greaterThan(point, above))) continue;
            square = std::min(square, preprocess::footing(point, t[0], t[1], t[2]).square);
        }
        return std::sqrt(square);
    }

    /// The least and the largest view depth of anything within the view of `camera`, whose image is square.
    std::pair<double, double> depths(const Camera& camera) const {
        selection::DetailView view;
        view.eye = camera.eye;
        view.basis = cameraBasis(camera);
        view.tanHalfX = view.tanHalfY = std::tan(camera.fovYRadians / 2);
        const ConvexVolume pyramid = selection::viewPyramid(view);
        culling::TriangleClipper clipper(pyramid);
        std::pair<double, double> result(std::numeric_limits<double>::infinity(), 0);
        for (const std::array<glm::dvec3, 3>& triangle : triangles_)
            for (const glm::dvec3& point : clipper.clipped(triangle)) {
                const double depth = glm::dot(view.basis.view, point - view.eye);
                result = {std::min(result.first, depth), std::max(result.second, depth)};
            }
        return result;
    }

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

double timeAt(const CameraPath& path, int sample) {
    return path.keyframes.front().time + path.duration() * sample / (kSamples - 1);
}

TEST(SuitedPath, AWalkPassesThroughNothingAndSeesNearAndFar) {
    const MadeModel plant("plant", 60000);
    const CameraPath path = suitedPath(plant.file(), "walk");
    constexpr double kClear = 0.3; // metres
    double longestStep = 0;
    glm::dvec3 before = cameraAt(path, timeAt(path, 0)).eye;
    for (int sample = 0; sample < kSamples; ++sample) {
        const Camera camera = cameraAt(path, timeAt(path, sample));
        EXPECT_DOUBLE_EQ(camera.eye.y, 1.7) << "eye height over a ground at 0";
        EXPECT_GE(plant.clearance(camera.eye, kClear), kClear) << "at sample " << sample;
        longestStep = std::max(longestStep, glm::distance(camera.eye, before));
        before = camera.eye;
    }
    EXPECT_LT(longestStep, 2 * kClear) << "nothing fits between two samples";
    EXPECT_GT(kSamples * longestStep, 30) << "that is no walk";
    for (const int sample : {0, kSamples / 2, kSamples - 1}) {
        const auto [least, greatest] = plant.depths(cameraAt(path, timeAt(path, sample)));
        EXPECT_GT(greatest / least, 30) << "a high depth range at sample " << sample;
    }
}

TEST(SuitedPath, AnApproachComesFromFarToVeryNear) {
    const MadeModel statue("statue", 20000);
    const Box& bounds = statue.file().summary().bounds;
    const double size = glm::length(bounds.extent());
    const CameraPath path = suitedPath(statue.file(), "approach");
    const glm::dvec3 end = cameraAt(path, timeAt(path, kSamples - 1)).eye;
    double before = std::numeric_limits<double>::infinity();
    for (int sample = 0; sample < kSamples - 1; sample += 8) {
        const glm::dvec3 eye = cameraAt(path, timeAt(path, sample)).eye;
        EXPECT_LT(glm::distance(eye, end), before) << "always nearer, at sample " << sample;
        EXPECT_GT(statue.clearance(eye, 0.1 * size), 1e-4 * size) << "never through the surface, at sample " << sample;
        before = glm::distance(eye, end);
    }
    EXPECT_GT(statue.clearance(cameraAt(path, timeAt(path, 0)).eye, 4 * size), 1.5 * size);
    EXPECT_LT(statue.clearance(end, size), 0.005 * size);
}

TEST(SuitedPath, OrbitAndFlybyStayOutsideAndLookAtTheModel) {
    const tests::TemporaryModel field({}, "field");
    const hierarchy::ModelFile file(field.path());
    const Box& bounds = file.summary().bounds;
    for (const char* kind : {"orbit", "flyby"}) {
        const CameraPath path = suitedPath(file, kind);
        for (int sample = 0; sample < kSamples; ++sample) {
            const Camera camera = cameraAt(path, timeAt(path, sample));
            EXPECT_GT(distance(bounds, camera.eye), 0) << kind;
            const glm::dvec3 towards = glm::normalize(camera.target - camera.eye);
            const glm::dvec3 middle = bounds.center() - camera.eye;
            if (path.loop) {
                EXPECT_GT(glm::dot(towards, glm::normalize(middle)), 0.99) << kind;
            }
        }
    }
}

TEST(SuitedPath, AModelWithoutAWayIsRefused) {
    tests::TinyModelOptions options; // hills that reach through every height at which one could walk
    options.height = 3;
    const tests::TemporaryModel field(options, "hills");
    const hierarchy::ModelFile file(field.path());
    EXPECT_THROW(suitedPath(file, "walk"), Error);
}

} // namespace
} // namespace gnomon::app
