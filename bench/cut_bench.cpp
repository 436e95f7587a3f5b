// Measures the time to select the clusters of a frame (its cut), in milliseconds.
//
// usage: cut_bench [MODEL.gnm] [options of Google Benchmark]
//
// The default model is a height field of 524,288 triangles. The model fills the image, and the light has four shadow
// maps. The error limit is chosen so that the image has about one million triangles, or all triangles of a smaller
// model. All pages that the cut uses are in memory. The first line of the output states the error limit, the pages and
// the triangles.
//
// The benchmarks are:
// - cut_image_one_core: the clusters of the image, on one thread
// - cut_and_casters_one_core: the clusters of the image and of four shadow maps, on one thread
// - cut_and_casters: the same lists, on all cores
// - visited_pages: the list of pages that may contain groups to refine
// - demand: the list of pages that a cut uses or wants
// - depth_range: min and max view depth of the image
// - triangle_cap_half: the error limit for half of the triangles
// - page_trees: the bounding volume trees over all pages
#include "lod/caster_detail.h"
#include "lod/frame_cut.h"
#include "lod/page_store.h"
#include "lod/receivers.h"
#include "shadow/setup.h"
#include "tests/support/tiny_model.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace gnomon {
namespace {

constexpr std::uint64_t kTriangles = 1000000; // wanted number of triangles in the image

/// A model that fills the image, with four shadow maps. All pages that the cut uses are in memory.
class Scene {
public:
    explicit Scene(const std::string& path)
        : model_(path),
          source_(model_),
          store_(source_, {.budget = gibibytes(4), .loaderThreads = 4, .onDamaged = {}}),
          trees_(model_.pages(), model_.summary().grid) {
        placeView();
        placePartitions();
        rule_ = std::make_unique<lod::ErrorRule>(view_, casters_);
        findThreshold();
    }

    lod::CutQuery query() const { return {&trees_, store_.resident(), rule_.get(), errorPixels_, volumes_}; }

    std::span<const hierarchy::PageInfo> table() const { return model_.pages(); }

    const hierarchy::Grid& grid() const { return model_.summary().grid; }

private:
    void placeView() {
        const Box& bounds = model_.summary().bounds;
        const double size = glm::length(bounds.extent());
        Camera camera;
        camera.target = bounds.center() - model_.summary().grid.origin;
        camera.eye = camera.target + glm::normalize(glm::dvec3(0.5, 0.35, 1)) * (0.55 * size);
        view_.eye = camera.eye;
        view_.basis = cameraBasis(camera);
        view_.nearestDepth = 1e-3 * size;
        far_ = 1.2 * size;
    }

    void placePartitions() {
        shadow::ShadowView view;
        view.frustum.near = far_ / 100;
        view.frustum.far = far_;
        view.towardsLight = toCamera(view_.basis, glm::normalize(glm::dvec3(0.4, 1, 0.3)));
        shadow::ShadowOptions options;
        options.scheme.slices = 4;
        volumes_.push_back(lod::viewPyramid(view_));
        const shadow::ShadowMapSetup setup = shadow::shadowMapSetup(view, options);
        for (const shadow::ShadowMap& map : setup.maps) {
            casters_.push_back(lod::casterDetail(view_, map));
            volumes_.push_back(casters_.back().casters);
        }
    }

    /// Finds the error limit at which the image has about kTriangles triangles, or all triangles of a smaller model.
    /// Loads all pages for this limit and prints the statistics of the cut.
    void findThreshold() {
        double tooFine = 1e-3;
        double tooCoarse = 1e3;
        for (int step = 0; step < 24; ++step) {
            errorPixels_ = std::sqrt(tooFine * tooCoarse);
            (load().lists.image.triangles > kTriangles ? tooFine : tooCoarse) = errorPixels_;
        }
        const lod::Cut cut = load();
        std::printf("%.3f pixels of error, pages %zu of %zu, triangles", errorPixels_, cut.used.size(), table().size());
        for (const lod::DrawList* list : cut.lists.all())
            std::printf(" %llu", static_cast<unsigned long long>(list->triangles));
        std::printf(", clusters in the image %llu\n", static_cast<unsigned long long>(cut.lists.image.clusters));
    }

    /// Loads pages until the cut has all pages that it wants, and returns this cut.
    lod::Cut load() {
        while (true) {
            lod::Cut cut = lod::cut(query());
            if (!store_.load({cut.used, cut.wanted}).hasChanged) return cut;
        }
    }

    hierarchy::ModelFile model_;
    lod::FilePageSource source_;
    lod::PageStore store_;
    lod::PageTrees trees_;
    lod::DetailView view_;
    double far_ = 0;
    std::vector<lod::CasterDetail> casters_;
    std::vector<ConvexVolume> volumes_;
    std::unique_ptr<lod::ErrorRule> rule_;
    double errorPixels_ = 1;
};

/// Registers a benchmark that measures the wall-clock time and the processor time of `body`.
template <class Body>
void add(const char* name, const Body& body) {
    benchmark::RegisterBenchmark(
        name,
        [body](benchmark::State& state) {
            for (auto _ : state)
                body();
        })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

void addAll(const Scene& scene) {
    add("cut_image_one_core", [&] {
        lod::CutQuery query = scene.query();
        query.volumes = query.volumes.first(1);
        benchmark::DoNotOptimize(lod::cut(query));
    });
    add("cut_and_casters_one_core", [&] { benchmark::DoNotOptimize(lod::cut(scene.query())); });
    add("cut_and_casters", [&] { benchmark::DoNotOptimize(lod::cutFrame(scene.query())); });
    add("visited_pages", [&] {
        std::vector<std::uint32_t> missing;
        benchmark::DoNotOptimize(lod::visitedPages(scene.query(), missing));
    });
    add("demand", [&] { benchmark::DoNotOptimize(lod::demand(scene.query())); });
    const auto cut = std::make_shared<lod::Cut>(lod::cut(scene.query()));
    add("depth_range", [&, cut] { benchmark::DoNotOptimize(lod::visibleDepthRange(scene.query(), cut->lists.image)); });
    add("triangle_cap_half",
        [&, cut] { benchmark::DoNotOptimize(lod::cappedErrorPixels(scene.query(), cut->lists.image.triangles / 2)); });
    add("page_trees", [&] { benchmark::DoNotOptimize(lod::PageTrees(scene.table(), scene.grid())); });
}

int run(int argc, char** argv) {
    std::string path = (std::filesystem::temp_directory_path() / "gnomon_cut_bench.gnm").string();
    if (argc > 1 && argv[1][0] != '-') {
        path = argv[1];
    } else {
        tests::TinyModelOptions options;
        options.gridExponent = 9;
        options.groupClusters = 8;
        options.pageGroups = 8;
        tests::writeModel(tests::makeTinyModel(options), path);
    }
    const Scene scene(path);
    addAll(scene);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    return gnomon::run(argc, argv);
}
