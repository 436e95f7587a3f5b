// What the exact shadows of a frame will take, estimated from a few of its points and a few of its casters before
// anything of it is drawn.
#pragma once

#include "executor/exact_pass.h"
#include "frame/point_sums.h"
#include "plan/shadow_choice.h"

#include <array>
#include <vector>

namespace gnomon::frame {

/// The work of exact shadows, estimated frame after frame; keeps its memory.
///
/// The image is drawn with kSide pixels on its longer side and coarser clusters, each point of which that faces the
/// light stands for as many samples as a pixel of it has pixels. They are sorted into the cells that the samples will
/// be sorted into. Clusters that their receiver mask keeps are sampled by how many points lie under them, triangles
/// within those evenly, and what is found is scaled up. Nothing in it is random: equal frames give equal numbers.
class ExactEstimate {
public:
    static constexpr int kSide = 160;

    /// The size in pixels of the small image for a frame of `view`, with its proportions; no larger than the view.
    static glm::ivec2 sizeFor(const plan::View& view);

    /// The work for `frame`, whose image is drawn at sizeFor its view and may be as coarse as that shows;
    /// `exactCasters` and what the frame itself draws, `image`, are all that can cast. Runs in the caller's TBB arena.
    plan::ExactWork estimate(const executor::FrameDrawing& frame, const selection::DrawList& image);

private:
    static constexpr std::size_t kSlices = 4;

    /// A point that faces the light, in the shear along it.
    struct Point {
        double u = 0;
        double v = 0;
        double h = 0;
        double error = 0; // what stands before it by less may be its own surface
        std::size_t slice = 0;
    };

    /// One of the four maps in 2048x2048 texels that would be drawn in place of exact shadows.
    struct Slice {
        exact::ReceiverMask mask; // of its own points
        AskedCells asked;
        exact::CellBox cells;        // of all these
        double texelsOfCell() const; // of a map that just covers these
    };

    /// A caster that the mask keeps.
    struct KeptCluster {
        const hierarchy::Page* page = nullptr;
        std::uint32_t cluster = 0;
        double points = 0; // under its box
        int slices = 0;    // that it may cast a shadow into
    };

    /// A triangle that stands for `weight` of those that are cast.
    struct PickedTriangle {
        exact::CellBox cells;
        double weight = 1;
        double points = 0; // in the rows that it goes over
        double area = 0;   // cells
        float highest = 0; // greatest h
    };

    void drawPoints(const executor::FrameDrawing& frame);
    void sortPoints(const executor::FrameDrawing& frame);
    void keepClusters(const executor::FrameDrawing& frame, std::span<const selection::ClusterRange> casters);
    void lowerMasks(const Point& point, int x, int y);
    void addKept(double weight, plan::ExactWork& work) const;
    void pickClusters(const executor::FrameDrawing& frame, double weight);
    void pickTriangles(const executor::FrameDrawing& frame, const KeptCluster& kept, double weight);
    void hold(
        const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& places, PickedTriangle& picked);
    static bool isCovered(const Point& point, const std::array<glm::dvec3, 3>& corners);
    std::size_t blockOf(const Point& point) const;
    std::vector<double> pointsOfBlocks() const;
    std::vector<double> sharesLeft(std::span<const double> points, double cast) const;
    void addRound(const PointSums& left, double share, double perPoint, plan::ExactWork& work) const;

    raster::Rasterizer rasterizer_;
    executor::SoftwarePass pass_;
    std::vector<std::uint64_t> words_;
    exact::LightShear shear_;
    std::vector<Point> points_, sorted_; // as they lie in the image, and by their cells
    glm::dmat3 cells_{1};                // from the light plane
    double leastW_ = 0;                  // points have at least twice that
    std::vector<std::uint32_t> cellOf_, first_;
    PointSums all_, left_; // of all points, and of those not dark yet
    exact::ReceiverMask mask_;
    std::array<Slice, kSlices> slices_;
    std::size_t stride_ = 1; // of the casters that are looked at
    std::vector<KeptCluster> kept_;
    std::vector<PickedTriangle> picked_;
    std::uint32_t trianglesOfCluster_ = 0; // that are looked at
    std::vector<double> coverers_;         // of the points of each block, summed
};

} // namespace gnomon::frame
