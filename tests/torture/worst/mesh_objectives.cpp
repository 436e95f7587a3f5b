// Meshes that genes draw, simplified as a patch, or built to a model and verified.
#include "core/progress.h"
#include "core/random.h"
#include "hierarchy/model_file.h"
#include "objectives.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/simplify/simplify.h"
#include "preprocess/verify/cracks.h"
#include "preprocess/verify/error_bound.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/source_soup.h"
#include "tests/support/code_mesh.h"
#include "tests/support/patches.h"

#include <cmath>
#include <filesystem>
#include <sstream>

#include <unistd.h>

namespace gnomon::torture {

namespace {

using simplify::Patch;
using simplify::Triangle;
using simplify::TriangleError;

/// A sheet of n x n squares over the unit square: waves, noise and creases, squeezed along one axis, with some of its
/// triangles left out, some doubled and some of its corners pulled onto others.
read::CodeMesh drawnSheet(Genes& genes, std::uint32_t min, std::uint32_t max) {
    const auto n = static_cast<std::uint32_t>(min + genes.below(max - min + 1));
    const double squeeze = std::pow(10.0, genes.uniform(-3, 0));
    const double wave = genes.uniform(0, 0.5);
    const double perUnit = std::pow(10.0, genes.uniform(0, 2));
    const double noise = std::pow(10.0, genes.uniform(-5, -0.5));
    const double crease = genes.uniform(-1, 1);
    const double holes = genes.unit() * 0.3;
    const double doubled = genes.unit() * 0.2;
    const double pulled = genes.unit() * 0.2;
    Random random(genes.seed());
    std::vector<glm::dvec3> positions;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) {
            const double u = static_cast<double>(x) / n;
            const double v = static_cast<double>(y) / n;
            const double height = wave * std::sin(perUnit * u) * std::cos(perUnit * v) + crease * std::abs(u - 0.5) +
                                  noise * random.uniform(-1, 1);
            positions.emplace_back(u, v * squeeze, height);
        }
    for (std::size_t i = 0; i + 1 < positions.size(); ++i)
        if (random.unit() < pulled) positions[i] = positions[i + 1];
    std::vector<Triangle> triangles;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (random.unit() < holes) return;
        triangles.push_back({a, b, c});
        if (random.unit() < doubled) triangles.push_back({a, c, b});
    };
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            add(a, a + 1, a + n + 2);
            add(a, a + n + 2, a + n + 1);
        }
    if (triangles.empty()) triangles.push_back({0, 1, n + 2});
    return {std::move(positions), std::move(triangles)};
}

/// The least share of its bound that any of the triangles leaves for a point: its distance and what it comes with, over
/// the triangle's stored error.
template <class ErrorOf>
double shareOf(
    const Patch& patch,
    const glm::dvec3& p,
    double before,
    std::span<const Triangle> triangles,
    const ErrorOf& errorOf) {
    double min = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const double distance = simplify::distanceTo(patch, p, triangles[t]) + before;
        min = std::min(min, distance / (errorOf(t) * (1 + 1e-9) + 1e-9));
    }
    return min;
}

/// The largest such share over points strewn on both surfaces.
double worstShare(const Patch& patch, const simplify::SimplifiedPatch& simplified, Random& random) {
    double worst = 0;
    const auto fromSource = [&](std::size_t t) { return double{simplified.errors[t].fromSource}; };
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const glm::dvec3 p = simplify::randomPoint(patch, patch.triangles[t], random);
        worst = std::max(worst, shareOf(patch, p, patch.error(t).fromSource, simplified.triangles, fromSource));
    }
    for (std::size_t s = 0; s < simplified.triangles.size(); ++s) {
        const glm::dvec3 p = simplify::randomPoint(patch, simplified.triangles[s], random);
        double min = std::numeric_limits<double>::infinity();
        const double bound = double{simplified.errors[s].toSource} * (1 + 1e-9) + 1e-9;
        for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
            const double distance = simplify::distanceTo(patch, p, patch.triangles[t]);
            min = std::min(min, (distance + double{patch.error(t).toSource}) / bound);
        }
        worst = std::max(worst, min);
    }
    return worst;
}

Score patchScore(Genes genes, Words words) {
    const read::CodeMesh mesh = drawnSheet(genes, 2, 9);
    Patch patch = simplify::patchOf(mesh);
    const double locked = genes.uniform(-0.2, 1);
    for (std::size_t i = 0; i < patch.isLocked.size(); ++i)
        patch.isLocked[i] = mesh.positions[i].x < locked ? 1 : 0;
    Random random(genes.seed());
    std::vector<TriangleError> errors(patch.triangles.size());
    const double before = genes.unit() * 20;
    for (TriangleError& error : errors)
        error = {
            static_cast<float>(random.below(3) == 0 ? random.unit() * before : 0),
            static_cast<float>(random.below(3) == 0 ? random.unit() * before : 0)};
    patch.errors = errors;
    const std::size_t target = 1 + genes.below(patch.triangles.size());
    const simplify::SimplifiedPatch simplified = simplify::simplifyQuadric(patch, target);
    Score score{worstShare(patch, simplified, random)};
    if (words == Words::Yes)
        score.where = std::to_string(patch.triangles.size()) + " triangles to " + std::to_string(target);
    return score;
}

/// A model is built, read and checked; gone afterwards.
class BuiltModel {
public:
    BuiltModel(read::CodeMesh& mesh, Genes& genes)
        : path_((std::filesystem::temp_directory_path() / ("gnomon_worst_" + std::to_string(::getpid()) + ".gnm"))
                    .string()) {
        pipeline::BuildOptions options;
        options.output = path_;
        options.isInMemory = true;
        options.threads = 1;
        options.chunkTriangles = static_cast<std::uint32_t>(64 + genes.below(4000));
        options.level.clusterTriangles = static_cast<std::uint32_t>(16 + genes.below(112));
        NoProgress progress;
        pipeline::buildModel(mesh, options, progress);
        model = verify::loadModel(hierarchy::ModelFile(path_), progress);
    }

    ~BuiltModel() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }

    BuiltModel(const BuiltModel&) = delete;
    BuiltModel& operator=(const BuiltModel&) = delete;
    BuiltModel(BuiltModel&&) = delete;
    BuiltModel& operator=(BuiltModel&&) = delete;

    verify::LoadedModel model;

private:
    std::string path_;
};

/// The largest sampled distance over its stored bound, and 10 for each crack.
Score modelScore(Genes genes, Words words) {
    read::CodeMesh mesh = drawnSheet(genes, 12, 40);
    const BuiltModel built(mesh, genes);
    NoProgress progress;
    const std::uint64_t seed = genes.seed();
    const verify::Check cracks = verify::checkCracks(built.model, 40, seed, progress);
    const verify::TriangleSoup soup = verify::readSoup(mesh, built.model.summary.grid, progress);
    const verify::Check errors = verify::checkErrorBound(built.model, soup, seed, progress);
    Score score{errors.worst + 10 * static_cast<double>(cracks.failed)};
    if (words == Words::Yes)
        score.where = std::to_string(mesh.triangles.size()) + " triangles; cracks " + std::to_string(cracks.failed) +
                      " " + cracks.detail + "; error " + std::to_string(errors.worst) + " " + errors.detail;
    return score;
}

} // namespace

std::vector<Objective> meshObjectives() {
    return {
        {"patch", "distance over the stored error of a simplified patch", 16, 1, 2, patchScore},
        {"model", "distance over the stored error of a cut, and 10 for each crack", 16, 1, 100, modelScore},
    };
}

} // namespace gnomon::torture
