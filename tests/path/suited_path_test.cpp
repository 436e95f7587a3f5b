// The paths that `gnomon path` finds: where they lead, and that a walk passes through nothing.
#include "core/error.h"
#include "culling/triangle_clip.h"
#include "hierarchy/temporary_model.h"
#include "path/suited_path.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/read/open_mesh_sources.h"
#include "selection/error_rule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace gnomon::path {
namespace {

constexpr int kSamples = 400; // along a path

/// Writes what `gnomon make` does.
auto made(const std::string& kind, std::uint64_t triangles) {
    return [=](const std::string& path) {
        NoProgress progress;
        make::writeMadeModel(*make::makeNamedModel(kind, triangles, 1), path, "made", 0, progress);
    };
}

/// A model written by `write(path)`, built; and its finest triangles, in world space.
class MadeModel {
public:
    template <class Write>
    explicit MadeModel(const Write& write) {
        const std::string stem =
            (std::filesystem::temp_directory_path() / ("gnomon_path_test_" + std::to_string(::getpid()))).string();
        write(stem + ".ply");
        NoProgress progress;
        pipeline::BuildOptions options;
        options.output = stem + ".gnm";
        const auto source = read::openMeshSources({stem + ".ply"}, gibibytes(1));
        pipeline::buildModel(*source, options, progress);
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
            square = std::min(square, proximity::distanceToTriangle(point, t[0], t[1], t[2]).square);
        }
        return std::sqrt(square);
    }

    /// The distances from `origin` along `direction` (unit length) to all that is there, nearest first.
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
    const MadeModel plant(made("plant", 60000));
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
    const MadeModel statue(made("statue", 20000));
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

/// A mesh of boxes.
struct Boxes {
    std::vector<glm::dvec3> corners;
    std::vector<std::array<std::size_t, 4>> quads;

    void add(const glm::dvec3& min, const glm::dvec3& max) {
        const std::size_t first = corners.size();
        for (unsigned i = 0; i < 8; ++i)
            corners.emplace_back(
                (i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y, (i & 4U) != 0 ? max.z : min.z);
        constexpr std::array<std::array<std::size_t, 4>, 6> kSides{
            {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
        for (const auto& q : kSides)
            quads.push_back({first + q[0], first + q[1], first + q[2], first + q[3]});
    }
};

/// Many small boxes in a flat grid, with gaps between them as wide as they are; far away on two sides one more each, so
/// that the grid is fine for the size of the model and coarse levels close its gaps.
struct Grating {
    int side = 60;          // boxes
    bool hasFloor = true;   // below, as wide as the grid
    double emptyRadius = 0; // where no boxes are, around the middle
    double reach = 100'000; // of the boxes far away

    void operator()(const std::string& path) const {
        Boxes boxes;
        for (int x = 0; x < side; ++x)
            for (int z = 0; z < side; ++z) {
                const glm::dvec3 middle(2 * x + 1.3 - side, 0, 2 * z + 1 - side);
                if (glm::length(middle) >= emptyRadius) boxes.add(middle - 0.5, middle + 0.5);
            }
        if (hasFloor) boxes.add({-side, -9, -side}, {side, -8, side});
        boxes.add({-reach, -1, -1}, {1 - reach, 0, 0});
        boxes.add({reach - 1, 0, 0}, {reach, 1, 1});
        std::ofstream file(path);
        file << "ply\nformat ascii 1.0\nelement vertex " << boxes.corners.size()
             << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << boxes.quads.size()
             << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const glm::dvec3& corner : boxes.corners)
            file << corner.x << ' ' << corner.y << ' ' << corner.z << '\n';
        for (const auto& q : boxes.quads)
            file << "4 " << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
    }
};

/// An approach to `model` leads straight to a surface of its full detail, with nothing before it.
void expectApproachEndsBeforeASurface(const MadeModel& model, const char* name) {
    const CameraPath path = suitedPath(model.file(), "approach");
    const glm::dvec3 start = path.keyframes.front().camera.eye;
    for (const Keyframe& key : path.keyframes) {
        const glm::dvec3 way = key.camera.target - key.camera.eye;
        const std::vector<double> met = model.met(key.camera.eye, glm::normalize(way));
        ASSERT_FALSE(met.empty()) << name << ", at " << key.time << " s";
        EXPECT_NEAR(met.front(), glm::length(way), 1e-9 * glm::distance(start, key.camera.target))
            << name << ", at " << key.time << " s";
    }
}

TEST(SuitedPath, AnApproachEndsBeforeASurfaceOfFullDetail) {
    expectApproachEndsBeforeASurface(MadeModel(made("statue", 20000)), "statue");
    expectApproachEndsBeforeASurface(MadeModel(made("plant", 60000)), "plant");
    expectApproachEndsBeforeASurface(MadeModel(made("planes", 20000)), "planes");
    for (int side = 40; side < 44; ++side) // the line meets a box or goes between two
        expectApproachEndsBeforeASurface(MadeModel(Grating{side, true, 0}), "grating");
}

TEST(SuitedPath, AnApproachFindsWhatThereIsAroundAnEmptyMiddle) {
    for (const double emptyRadius : {0.0, 10.0, 40.0})
        expectApproachEndsBeforeASurface(MadeModel(Grating{40, false, emptyRadius}), "grating without a floor");
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
} // namespace gnomon::path
