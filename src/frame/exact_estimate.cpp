#include "frame/exact_estimate.h"

#include "executor/frame_block.h"
#include "executor/view/lens.h"
#include "frame/light_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon::frame {

namespace {

constexpr std::size_t kMostClusters = 4096; // that are looked at
constexpr double kPickedClusters = 240;
constexpr double kPickedTriangles = 4096;     // shared by the clusters that are picked
constexpr std::uint32_t kLeastTriangles = 12; // of each

/// What stands before a point by less than so many of the small image's pixels may be its own surface.
constexpr double kErrorPixels = 2;

/// How far around a point the samples lie that it stands for, about, in cells.
constexpr int kReachCells = 1;

/// The points that a picked triangle is held against, at most.
constexpr double kPointsOfTriangle = 48;

/// Casters go in rounds of 1, 3 and 4 eighths, and what is dark leaves the cells after the first two where that is a
/// quarter or more of them (exact::ExactShadows).
constexpr std::array kRounds = {1.0 / 8, 3.0 / 8, 4.0 / 8};
constexpr double kLeastDark = 0.25;

/// Which of four slices of the plan's depths, as maps split them, holds a view depth.
std::size_t sliceAt(const plan::FramePlan& plan, double depth) {
    if (!(plan.near > 0 && plan.far > plan.near)) return 0;
    return static_cast<std::size_t>(
        std::clamp(4 * std::log(depth / plan.near) / std::log(plan.far / plan.near), 0.0, 3.0));
}

/// The clusters that one of the lists has, or both.
std::vector<selection::ClusterRange> ofEither(
    const std::vector<selection::ClusterRange>& a, const std::vector<selection::ClusterRange>& b) {
    std::vector<selection::ClusterRange> all(a);
    all.insert(all.end(), b.begin(), b.end());
    std::sort(all.begin(), all.end());
    std::vector<selection::ClusterRange> result;
    for (const selection::ClusterRange& range : all) {
        const bool isNext = result.empty() || range.page != result.back().page ||
                            range.firstCluster > result.back().firstCluster + result.back().clusterCount;
        if (isNext) {
            result.push_back(range);
            continue;
        }
        selection::ClusterRange& last = result.back();
        const std::uint32_t end =
            std::max(last.firstCluster + last.clusterCount, range.firstCluster + range.clusterCount);
        last.clusterCount = end - last.firstCluster;
    }
    return result;
}

} // namespace

glm::ivec2 ExactEstimate::sizeFor(const plan::View& view) {
    const double scale = std::min(1.0, double{kSide} / std::max(view.width, view.height));
    return {
        std::max(1, static_cast<int>(std::lround(view.width * scale))),
        std::max(1, static_cast<int>(std::lround(view.height * scale)))};
}

void ExactEstimate::drawPoints(const executor::FrameDrawing& frame) {
    const plan::FramePlan& plan = *frame.plan;
    const glm::ivec2 size = sizeFor(plan.view);
    words_.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    pass_.gather(frame, *frame.image, executor::Cutting::BySections);
    rasterizer_.drawVisibility(
        pass_.clusters(),
        executor::rasterView(frame.space, executor::imageClipFromDraw(frame), {0, 0, size.x, size.y}),
        {words_.data(), size.x, size.y});
    const glm::dvec3 light = plan.light.unit();
    const double perDepth = kErrorPixels * 2 * plan.view.tanHalfY() / size.y;
    const executor::Lens lens = executor::lensOf(frame);
    points_.clear();
    for (std::size_t i = 0; i < words_.size(); ++i) {
        if (words_[i] == 0) continue;
        const std::uint32_t name = raster::visibleTriangle(words_[i]);
        const executor::DrawnCluster& drawn = pass_.drawn()[name >> executor::kTriangleBits];
        const hierarchy::Triangle& triangle = drawn.triangles[name & (raster::kMaxClusterTriangles - 1)];
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = fromOrigin(drawn.vertices[triangle[k]].position, frame.space.originCell);
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 eye = frame.space.eye / frame.space.step;
        if (!(glm::dot(normal, light) * glm::dot(normal, eye - corners[0]) > 0)) continue;
        const auto width = static_cast<std::size_t>(size.x);
        const std::size_t column = i % width;
        const std::size_t line = i / width;
        const glm::dvec2 at(
            2 * (static_cast<double>(column) + 0.5) / size.x - 1, 2 * (static_cast<double>(line) + 0.5) / size.y - 1);
        const double worldDepth = lens.depth.fromEye(raster::visibleDepth(words_[i]));
        const double depth = worldDepth / frame.space.step;
        const glm::dvec3 p = sheared(shear_, eye + toWorld(plan.basis, lens.seenAt(at, worldDepth) / frame.space.step));
        points_.push_back({p.x, p.y, p.z, depth * perDepth, sliceAt(plan, worldDepth)});
    }
}

double ExactEstimate::Slice::texelsOfCell() const {
    constexpr double kTexels = 1024.0 * 1024;
    return kTexels / ((cells.x1 - cells.x0 + 1.0) * (cells.y1 - cells.y0 + 1.0));
}

/// Tells the masks of a point in cell (x, y), which stands for others around it.
void ExactEstimate::lowerMasks(const Point& point, int x, int y) {
    Slice& slice = slices_[point.slice];
    const auto block = [](int cell) { return std::clamp(cell, 0, plan::kCellSide - 1) >> kBlockBits; };
    const auto first = [&](int cell) { return block(cell - kReachCells) << kBlockBits; };
    const auto last = [&](int cell) { return block(cell + kReachCells) << kBlockBits | (kBlockSide - 1); };
    slice.cells = {
        std::min(slice.cells.x0, first(x)),
        std::min(slice.cells.y0, first(y)),
        std::max(slice.cells.x1, last(x)),
        std::max(slice.cells.y1, last(y))};
    for (const int i : {-kReachCells, kReachCells})
        for (const int j : {-kReachCells, kReachCells})
            for (exact::ReceiverMask* mask : {&mask_, &slice.mask}) {
                float& lowest = mask->lowest(block(x + i), block(y + j));
                lowest = std::min(lowest, static_cast<float>(point.h));
            }
}

void ExactEstimate::sortPoints(const executor::FrameDrawing& frame) {
    cells_ = executor::cellPlanes(frame, shear_).front();
    glm::dvec2 low{};
    glm::dvec2 high{};
    const auto fit = [&] {
        low = glm::dvec2(std::numeric_limits<double>::infinity());
        high = -low;
        leastW_ = low.x;
        for (const Point& point : points_) {
            const glm::dvec3 p = cells_ * glm::dvec3(point.u, point.v, 1);
            leastW_ = std::min(leastW_, p.z);
            low = glm::min(low, glm::dvec2(p) / p.z);
            high = glm::max(high, glm::dvec2(p) / p.z);
        }
    };
    fit();
    if (!(leastW_ > 0)) {
        cells_ = glm::dmat3(1);
        fit();
    }
    leastW_ /= 2;
    const glm::dvec2 scale = plan::kCellSide * 0.998 / glm::max(high - low, glm::dvec2(1e-300));
    const glm::dvec2 offset = glm::dvec2(plan::kCellSide * 0.001) - low * scale;
    cells_ = glm::dmat3(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0), glm::dvec3(offset, 1)) * cells_;
    first_.assign(plan::kCellSide * plan::kCellSide + 1, 0);
    cellOf_.clear();
    mask_.reset(plan::kCellSide, plan::kCellSide);
    for (Slice& slice : slices_) {
        slice.mask.reset(plan::kCellSide, plan::kCellSide);
        slice.cells = {plan::kCellSide, plan::kCellSide, -1, -1};
    }
    for (const Point& point : points_) {
        const glm::dvec3 p = cells_ * glm::dvec3(point.u, point.v, 1);
        const int x = exact::cellAt(p.x / p.z, plan::kCellSide);
        const int y = exact::cellAt(p.y / p.z, plan::kCellSide);
        cellOf_.push_back(static_cast<std::uint32_t>(y * plan::kCellSide + x));
        ++first_[cellOf_.back() + 1];
        lowerMasks(point, x, y);
    }
    for (Slice& slice : slices_) {
        slice.mask.finish();
        slice.asked.add(slice.mask);
    }
    mask_.finish();
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
    sorted_.resize(points_.size());
    for (std::size_t i = points_.size(); i-- > 0;)
        sorted_[--first_[cellOf_[i] + 1]] = points_[i];
    // Each first_[i + 1] now is the first of cell i; what lay before it has moved one place down.
    std::move(first_.begin() + 1, first_.end(), first_.begin());
    first_.back() = static_cast<std::uint32_t>(points_.size());
    coverers_.assign(kBlocks * kBlocks, 0);
}

/// Of every `stride_`-th caster those that the mask keeps.
void ExactEstimate::keepClusters(
    const executor::FrameDrawing& frame, std::span<const selection::ClusterRange> casters) {
    kept_.clear();
    std::size_t place = 0;
    for (const selection::ClusterRange& range : casters) {
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (place++ % stride_ != 0) continue;
            const hierarchy::GridBox& box = page.clusters[c].box;
            const hierarchy::GridPoint& origin = frame.space.originCell;
            const LightBox light =
                lightBox(shear_, cells_, leastW_, fromOrigin(box.min, origin), fromOrigin(box.max, origin));
            if (light.cells.empty() || !mask_.mayShadow(light.cells, light.highest)) continue;
            const auto isShadowed = [&](const Slice& slice) {
                return !slice.cells.empty() && slice.mask.mayShadow(light.cells, light.highest);
            };
            const auto slices = std::count_if(slices_.begin(), slices_.end(), isShadowed);
            kept_.push_back({&page, c, all_.in(light.cells), static_cast<int>(slices)});
        }
    }
}

void ExactEstimate::pickTriangles(const executor::FrameDrawing& frame, const KeptCluster& kept, double weight) {
    const hierarchy::Cluster& cluster = kept.page->clusters[kept.cluster];
    const std::uint32_t stride = (cluster.triangleCount + trianglesOfCluster_ - 1) / trianglesOfCluster_;
    const std::uint32_t first = kept.cluster % stride;
    const std::uint32_t looked = (cluster.triangleCount - first + stride - 1) / stride;
    for (std::uint32_t t = first; t < cluster.triangleCount; t += stride) {
        std::array<glm::dvec3, 3> corners{};
        std::array<glm::dvec3, 3> places{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = cluster.firstVertex + kept.page->triangles[cluster.firstTriangle + t][k];
            corners[k] = sheared(shear_, fromOrigin(kept.page->vertices[vertex].position, frame.space.originCell));
            places[k] = cells_ * glm::dvec3(corners[k].x, corners[k].y, 1);
        }
        const exact::CellBox box = cellsOf(places, leastW_);
        const double highest = std::max({corners[0].z, corners[1].z, corners[2].z});
        if (box.empty() || !mask_.mayShadow(box, static_cast<float>(highest))) continue;
        picked_.push_back(
            {box,
             weight * cluster.triangleCount / looked,
             0,
             coveredArea(places, leastW_, box),
             static_cast<float>(highest)});
        hold(corners, places, picked_.back());
    }
}

/// Counts the points in the rows that a picked triangle goes over, and tells the blocks of those that it covers.
void ExactEstimate::hold(
    const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& places, PickedTriangle& picked) {
    const exact::CellBox& box = picked.cells;
    const bool isCut = std::any_of(places.begin(), places.end(), [&](const glm::dvec3& p) { return p.z < leastW_; });
    const bool isNarrowed = !isCut && box.x1 - box.x0 > 1 && box.y1 > box.y0;
    std::array<glm::dvec2, 3> outline{};
    for (std::size_t k = 0; k < 3; ++k)
        outline[k] = glm::dvec2(places[k]) / places[k].z;
    const double stride = std::max(1.0, all_.in(box) / kPointsOfTriangle);
    double next = stride / 2;
    for (int row = box.y0; row <= box.y1; ++row) {
        const exact::CellBox span = isNarrowed ? rowSpan(outline, box, row) : exact::CellBox{box.x0, row, box.x1, row};
        if (span.empty()) continue;
        const std::size_t rowStart = static_cast<std::size_t>(row) * plan::kCellSide;
        const std::uint32_t begin = first_[rowStart + static_cast<std::size_t>(span.x0)];
        const std::uint32_t end = first_[rowStart + static_cast<std::size_t>(span.x1) + 1];
        for (; picked.points + (end - begin) > next; next += stride) {
            const std::uint32_t i = begin + static_cast<std::uint32_t>(next - picked.points);
            if (i < end && isCovered(sorted_[i], corners)) coverers_[blockOf(sorted_[i])] += picked.weight * stride;
        }
        picked.points += end - begin;
    }
}

/// Whether a triangle, in the shear of the light, stands before a point by more than its error.
bool ExactEstimate::isCovered(const Point& point, const std::array<glm::dvec3, 3>& corners) {
    const auto edge = [](const glm::dvec3& a, const glm::dvec3& b, double u, double v) {
        return (b.x - a.x) * (v - a.y) - (b.y - a.y) * (u - a.x);
    };
    const double c = edge(corners[0], corners[1], point.u, point.v);
    const double a = edge(corners[1], corners[2], point.u, point.v);
    const double b = edge(corners[2], corners[0], point.u, point.v);
    if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) || a + b + c == 0) return false;
    return (a * corners[0].z + b * corners[1].z + c * corners[2].z) / (a + b + c) > point.h + point.error;
}

std::size_t ExactEstimate::blockOf(const Point& point) const {
    const glm::dvec3 p = cells_ * glm::dvec3(point.u, point.v, 1);
    const auto block = [](double x) {
        return static_cast<std::size_t>(exact::cellAt(x, plan::kCellSide) >> kBlockBits);
    };
    return block(p.y / p.z) * kBlocks + block(p.x / p.z);
}

std::vector<double> ExactEstimate::pointsOfBlocks() const {
    std::vector<double> points;
    for (std::size_t y = 0; y < kBlocks; ++y)
        for (std::size_t x = 0; x < kBlocks; ++x) {
            const auto at = [](std::size_t block) { return static_cast<int>(block) << kBlockBits; };
            points.push_back(all_.in({at(x), at(y), at(x + 1) - 1, at(y + 1) - 1}));
        }
    return points;
}

/// What share of the points of each block, of which there are `points`, is not dark yet once `cast` of all casters went
/// over them: a point that k casters stand before is left with e^(-k cast).
std::vector<double> ExactEstimate::sharesLeft(std::span<const double> points, double cast) const {
    std::vector<double> shares(points.size(), 1);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i] > 0) shares[i] = std::exp(-cast * coverers_[i] / points[i]);
    return shares;
}

void ExactEstimate::addRound(const PointSums& left, double share, double perPoint, plan::ExactWork& work) const {
    for (const PickedTriangle& picked : picked_) {
        const exact::CellBox& box = picked.cells;
        // The mask knows of whole blocks.
        const exact::CellBox known{
            box.x0 >> kBlockBits << kBlockBits,
            box.y0 >> kBlockBits << kBlockBits,
            std::min(plan::kCellSide - 1, box.x1 | (kBlockSide - 1)),
            std::min(plan::kCellSide - 1, box.y1 | (kBlockSide - 1))};
        const double points = all_.in(box);
        const double ofBlocks = all_.in(known);
        const double isKept = ofBlocks > 0 ? 1 - std::exp(-perPoint * left.in(known)) : 1;
        work.castTriangles += share * picked.weight * isKept;
        if (points > 0) work.sampleTests += share * picked.weight * perPoint * picked.points * left.in(box) / points;
    }
}

/// What maps would draw of the kept clusters: whole clusters, but no texels of triangles that lie below all points.
void ExactEstimate::addKept(double weight, plan::ExactWork& work) const {
    for (const KeptCluster& kept : kept_)
        work.keptTriangles += weight * kept.page->clusters[kept.cluster].triangleCount * kept.slices;
    for (const PickedTriangle& picked : picked_) {
        const exact::CellBox& box = picked.cells;
        const double cells = (box.x1 - box.x0 + 1.0) * (box.y1 - box.y0 + 1.0);
        for (const Slice& slice : slices_)
            if (!slice.cells.empty() && slice.mask.mayShadow(box, picked.highest))
                work.mapFragments += picked.weight * picked.area * slice.asked.in(box) / cells * slice.texelsOfCell();
    }
}

void ExactEstimate::pickClusters(const executor::FrameDrawing& frame, double weight) {
    double triangles = 0;
    double points = 0;
    for (const KeptCluster& kept : kept_) {
        triangles += kept.page->clusters[kept.cluster].triangleCount;
        points += kept.points;
    }
    picked_.clear();
    const double clusters = std::max(1.0, std::min(kPickedClusters, static_cast<double>(kept_.size())));
    trianglesOfCluster_ = std::max(kLeastTriangles, static_cast<std::uint32_t>(kPickedTriangles / clusters));
    double sum = 0.5;
    for (const KeptCluster& kept : kept_) {
        const double share = 0.5 * kept.page->clusters[kept.cluster].triangleCount / triangles +
                             (points > 0 ? 0.5 * kept.points / points : 0);
        const double chance = std::min(1.0, kPickedClusters * share);
        const double before = std::floor(sum);
        sum += chance;
        if (std::floor(sum) > before) pickTriangles(frame, kept, weight / chance);
    }
}

plan::ExactWork ExactEstimate::estimate(const executor::FrameDrawing& frame, const selection::DrawList& image) {
    plan::ExactWork work;
    work.casterTriangles = static_cast<double>(frame.exactCasters->triangles);
    if (frame.plan->cellMaps.empty()) return work;
    shear_ = exact::shearAlong(frame.plan->light);
    drawPoints(frame);
    if (points_.empty()) return work;
    const plan::View& view = frame.plan->view;
    const double perPoint = static_cast<double>(view.width) * view.height / static_cast<double>(words_.size());
    work.samples = perPoint * static_cast<double>(points_.size());
    sortPoints(frame);
    all_.add(first_, {});
    const std::vector<selection::ClusterRange> casters = ofEither(frame.exactCasters->ranges, image.ranges);
    std::size_t clusters = 0;
    for (const selection::ClusterRange& range : casters)
        clusters += range.clusterCount;
    stride_ = std::max<std::size_t>(1, (clusters + kMostClusters - 1) / kMostClusters);
    keepClusters(frame, casters);
    pickClusters(frame, static_cast<double>(stride_));
    addKept(static_cast<double>(stride_), work);
    left_ = all_;
    const std::vector<double> ofBlocks = pointsOfBlocks();
    auto points = static_cast<double>(points_.size());
    double cast = 0;
    for (const double share : kRounds) {
        addRound(left_, share, perPoint, work);
        cast += share;
        const std::vector<double> shares = sharesLeft(ofBlocks, cast);
        const double stay = std::inner_product(shares.begin(), shares.end(), ofBlocks.begin(), 0.0);
        if (cast >= 1 || stay > (1 - kLeastDark) * points) continue;
        points = stay;
        left_.add(first_, shares);
    }
    return work;
}

} // namespace gnomon::frame
