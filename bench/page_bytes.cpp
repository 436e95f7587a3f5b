// What of the bytes that a picture reads it draws: pages, refined groups, drawn clusters.
// page_bytes MODEL.gnm [ERROR_PIXELS] [DISTANCE]: seen from that many diagonals away, without shadows, 800 pixels high.
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

/// Of stored bytes: a page's are its clusters' by their triangles.
struct Shares {
    double tables = 0;
    double pages = 0; // that hold what is refined, or that such a page refines: what a frame reads that never waits
    double refinedPages = 0;   // that hold what is refined
    double skippablePages = 0; // of these, that the page table alone says to be refined as a whole
    double undrawnPages = 0;   // of these, all of which nothing is drawn
    double groups = 0;
    double clusters = 0;
    double triangles = 0;
    std::uint64_t requests = 0;
};

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
    /// What the pages take of which something is refined, or drawn, and those above them.
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
