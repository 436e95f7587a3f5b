// Measures how many bytes of a model file one image reads, and how many of them belong to drawn clusters.
//
// usage: page_bytes MODEL.gnm [ERROR_PIXELS] [DISTANCE]
//
// The image is 800 pixels high and has no shadows. ERROR_PIXELS is the error limit in pixels (default: 1). DISTANCE is
// the distance from the eye to the centre of the model, in diagonals of its bounding box (default: 1).
//
// The program prints megabytes (10^6 bytes) of stored pages, for the following sets:
// - pages that the image reads: pages with refined groups, except those that the page table alone proves refined
// - drawn clusters, and the ratio of read bytes to drawn bytes
// - refined groups that are not drawn, and other groups in the pages with refined groups
// - pages with refined groups but without drawn clusters
// - with --no-wait: all pages with refined groups, and all coarser pages above them
#include "core/camera.h"
#include "hierarchy/cut_rule.h"
#include "hierarchy/model_file.h"
#include "lod/cut.h"
#include "lod/error_rule.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

namespace gnomon {
namespace {

/// Stored bytes of the model file, by their use in one image. The bytes of a page are distributed over its clusters in
/// proportion to their triangles.
struct Shares {
    double tables = 0;          // page table
    double pages = 0;           // pages with refined groups, and all coarser pages above them (read with --no-wait)
    double refinedPages = 0;    // pages with refined groups
    double skippablePages = 0;  // part of refinedPages: the page table proves that all groups are refined
    double undrawnPages = 0;    // part of refinedPages: no cluster is drawn
    double groups = 0;          // refined groups
    double clusters = 0;        // drawn clusters in the view frustum
    double triangles = 0;       // number of triangles of the drawn clusters
    std::uint64_t requests = 0; // number of pages that the image reads
};

/// Selects the drawn clusters of one view of a model, and sums their bytes.
class Count {
public:
    Count(const hierarchy::ModelFile& file, double errorPixels, double distance)
        : file_(file),
          errorPixels_(errorPixels),
          isNeeded_(file.pages().size()),
          trees_(file.pages(), file.summary().grid) {
        const hierarchy::ModelSummary& summary = file.summary();
        const double size = glm::length(summary.bounds.extent());
        Camera camera;
        camera.target = summary.bounds.center() - summary.grid.origin;
        camera.eye = camera.target + glm::normalize(glm::dvec3(0.5, 0.35, 1)) * (distance * size);
        view_.eye = camera.eye;
        view_.basis = cameraBasis(camera);
        view_.nearestDepth = 1e-3 * size;
        rule_ = std::make_unique<lod::ErrorRule>(view_);
    }

    Shares run() {
        Shares sum;
        std::vector<std::uint8_t> isRefined(isNeeded_.size());
        std::vector<std::uint8_t> isDrawn(isNeeded_.size());
        const ConvexVolume pyramid = lod::viewPyramid(view_);
        for (std::uint32_t p = 0; p < isNeeded_.size(); ++p) {
            const hierarchy::Page page = file_.readPage(p);
            const hierarchy::PageInfo& info = file_.pages()[p];
            sum.tables += 112 + 4.0 * static_cast<double>(info.children.size());
            const double each = double(info.storedBytes) / info.triangleCount;
            for (const hierarchy::Group& group : page.groups) {
                if (group.error < std::numeric_limits<double>::infinity() && !refines(group.drawnError(), group.bounds))
                    continue;
                isRefined[p] = 1;
                for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
                    sum.groups += each * page.clusters[c].triangleCount;
            }
            hierarchy::forEachDrawn(
                page,
                [this](double error, const Sphere& bounds) { return refines(error, bounds); },
                [&](const hierarchy::Group&, const hierarchy::Cluster& cluster) {
                    if (classify(pyramid, file_.summary().grid.local(cluster.box)) == Containment::Outside) return;
                    isDrawn[p] = 1;
                    sum.clusters += each * cluster.triangleCount;
                    sum.triangles += cluster.triangleCount;
                });
        }
        addPages(isRefined, isDrawn, sum);
        return sum;
    }

private:
    /// Adds the bytes of pages to `sum`. `isRefined` and `isDrawn` are 1 for pages with refined groups and for pages
    /// with drawn clusters. Sets `isNeeded_` also for all coarser pages above refined pages.
    void addPages(const std::vector<std::uint8_t>& isRefined, const std::vector<std::uint8_t>& isDrawn, Shares& sum) {
        lod::CutQuery query;
        query.trees = &trees_;
        query.rule = rule_.get();
        query.errorPixels = errorPixels_;
        query.passable = file_.pages();
        for (std::size_t p = isNeeded_.size(); p-- > 0;) {
            const hierarchy::PageInfo& info = file_.pages()[p];
            isNeeded_[p] = isRefined[p];
            for (const std::uint32_t child : info.children)
                isNeeded_[p] |= isNeeded_[child];
            if (isRefined[p] != 0) {
                const bool isPassed = lod::isSkippable(query, static_cast<std::uint32_t>(p));
                sum.refinedPages += info.storedBytes;
                if (isPassed) sum.skippablePages += info.storedBytes;
                if (isDrawn[p] == 0) sum.undrawnPages += info.storedBytes;
                if (!isPassed) ++sum.requests;
            }
            if (isNeeded_[p] != 0) sum.pages += info.storedBytes;
        }
    }

    /// Returns true if the error of a group with these bounds exceeds the error limit.
    bool refines(double error, const Sphere& bounds) const { return rule_->exceeds(bounds, error, errorPixels_); }

    const hierarchy::ModelFile& file_;
    double errorPixels_;
    std::vector<std::uint8_t> isNeeded_;
    lod::DetailView view_;
    std::unique_ptr<lod::ErrorRule> rule_;
    lod::PageTrees trees_;
};

int run(int argc, char** argv) {
    const hierarchy::ModelFile file(argv[1]);
    const Shares sum = Count(file, argc > 2 ? std::atof(argv[2]) : 1, argc > 3 ? std::atof(argv[3]) : 1).run();
    constexpr double kMega = 1e6;
    const double read = sum.refinedPages - sum.skippablePages;
    std::printf(
        "%zu pages of %.1f MB, table %.2f MB; a picture reads %llu pages, MB as stored: %.2f; drawn clusters (%.0f "
        "triangles) %.2f; read / drawn %.2f\n",
        file.pages().size(),
        double(file.fileBytes()) / kMega,
        sum.tables / kMega,
        static_cast<unsigned long long>(sum.requests),
        read / kMega,
        sum.triangles,
        sum.clusters / kMega,
        read / sum.clusters);
    std::printf(
        "refined groups above what is drawn %.2f, other groups in these pages %.2f; of these pages nothing is drawn of "
        "%.2f, known by the table of %.2f, which are not read\n",
        (sum.groups - sum.clusters) / kMega,
        (sum.refinedPages - sum.groups) / kMega,
        sum.undrawnPages / kMega,
        sum.skippablePages / kMega);
    std::printf(
        "with --no-wait: %.2f, %.2f of them pages of which nothing is refined; read / drawn %.2f\n",
        sum.pages / kMega,
        (sum.pages - sum.refinedPages) / kMega,
        sum.pages / sum.clusters);
    return 0;
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    return gnomon::run(argc, argv);
}
