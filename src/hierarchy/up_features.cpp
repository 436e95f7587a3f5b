#include "hierarchy/up_features.h"

#include "core/box.h"

#include <algorithm>
#include <cmath>

namespace gnomon::hierarchy {

namespace {

constexpr double kSamples = 20'000;
constexpr double kMaxSplits = 100; // max number of parts into which a side of a triangle is divided
constexpr int kColumns = 48;       // cells per side of the square grid
constexpr int kVoxels = 32;
constexpr double kWithin10 = 0.985; // cosine of 10 degrees; the sine of 10 degrees is 0.17
constexpr double kWithin20 = 0.94;
constexpr double kTiny = 1e-9;

using Corners = std::array<glm::vec3, 3>;
using Outline = std::vector<glm::dvec2>;
using Cells = std::vector<char>;

/// A sample point of the surface, and the surface area that it represents.
struct Sample {
    glm::dvec3 at{0};
    glm::dvec3 facing{0}; // area vector: normal times area
    double area = 0;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Projects `position` along `axis`: returns its two other coordinates.
glm::dvec2 across(const glm::dvec3& position, int axis) {
    return {position[(axis + 1) % 3], position[(axis + 2) % 3]};
}

/// Returns the convex hull of `points` in counter-clockwise order (Andrew 1979).
Outline hullOf(Outline points) {
    std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Outline hull;
    const auto add = [&](const glm::dvec2& point, std::size_t kept) {
        while (hull.size() > kept && cross(hull.back() - hull[hull.size() - 2], point - hull[hull.size() - 2]) <= 0)
            hull.pop_back();
        hull.push_back(point);
    };
    for (const glm::dvec2& point : points)
        add(point, 1);
    const std::size_t lower = hull.size();
    for (std::size_t i = points.size() - 1; i-- > 0;)
        add(points[i], lower);
    hull.pop_back();
    return hull;
}

double areaOf(const Outline& hull) {
    double twice = 0;
    for (std::size_t i = 2; i < hull.size(); ++i)
        twice += cross(hull[i - 1] - hull[0], hull[i] - hull[0]);
    return twice / 2;
}

/// Returns the distance from `point` to the border of the convex hull. It is negative outside the hull, and -1 for a
/// hull without area.
double depthIn(const Outline& hull, const glm::dvec2& point) {
    if (hull.size() < 3) return -1;
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 side = hull[(i + 1) % hull.size()] - hull[i];
        const double length = glm::length(side);
        if (length > 0) depth = std::min(depth, cross(side, point - hull[i]) / length);
    }
    return depth;
}

/// Returns the number of connected components of the cells that are set. Two cells with a common corner are connected.
double partsOf(Cells cells) {
    int parts = 0;
    std::vector<int> open;
    for (int first = 0; first < kColumns * kColumns; ++first) {
        if (cells[static_cast<std::size_t>(first)] == 0) continue;
        ++parts;
        open.assign(1, first);
        cells[static_cast<std::size_t>(first)] = 0;
        while (!open.empty()) {
            const int x = open.back() / kColumns;
            const int y = open.back() % kColumns;
            open.pop_back();
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, kColumns - 1); ++i)
                for (int j = std::max(y - 1, 0); j <= std::min(y + 1, kColumns - 1); ++j)
                    if (char& cell = cells[std::size_t(i) * kColumns + std::size_t(j)]; cell != 0) {
                        cell = 0;
                        open.push_back(i * kColumns + j);
                    }
        }
    }
    return parts;
}

double countOf(const Cells& cells) {
    return static_cast<double>(std::count(cells.begin(), cells.end(), 1));
}

/// A surface, scaled to a cube of side 1 around the origin, with sample points that represent approximately equal
/// areas.
class Surface {
public:
    explicit Surface(std::span<const Corners> triangles) {
        Box box;
        for (const Corners& triangle : triangles)
            for (const glm::vec3& corner : triangle)
                box.add(glm::dvec3(corner));
        const glm::dvec3 size = box.extent();
        const double longest = std::max({size.x, size.y, size.z});
        if (!(longest > 0)) return;
        extent_ = size / longest;
        vertices_.reserve(3 * triangles.size());
        for (const Corners& triangle : triangles)
            for (const glm::vec3& corner : triangle)
                vertices_.push_back((glm::dvec3(corner) - box.center()) / longest);
        double area = 0;
        for (std::size_t i = 0; i < vertices_.size(); i += 3)
            area += glm::length(areaVector(i));
        if (!(area > 0)) return;
        for (std::size_t i = 0; i < vertices_.size(); i += 3)
            addSamples(i, area);
        for (const Sample& sample : samples_) {
            area_ += sample.area;
            middle_ += sample.area * sample.at;
            facing_ += sample.facing;
        }
        middle_ /= area_;
    }

    const glm::dvec3& extent() const { return extent_; }

    const std::vector<glm::dvec3>& vertices() const { return vertices_; }

    const std::vector<Sample>& samples() const { return samples_; }

    double area() const { return area_; }

    const glm::dvec3& middle() const { return middle_; }

    const glm::dvec3& facing() const { return facing_; }

private:
    glm::dvec3 areaVector(std::size_t first) const {
        return 0.5 * glm::cross(vertices_[first + 1] - vertices_[first], vertices_[first + 2] - vertices_[first]);
    }

    /// Adds sample points on a triangle. A large triangle is divided into equal small triangles, each with one sample.
    /// For small triangles, one sample represents all triangles since the last sample.
    void addSamples(std::size_t first, double areaOfAll) {
        const glm::dvec3 facing = areaVector(first);
        const double area = glm::length(facing);
        if (!(area > 0)) return;
        const double splits = std::min(std::floor(std::sqrt(area / areaOfAll * kSamples)), kMaxSplits);
        if (splits < 2) {
            carried_ += area;
            if (carried_ < areaOfAll / kSamples) return;
            const glm::dvec3 middle = (vertices_[first] + vertices_[first + 1] + vertices_[first + 2]) / 3.0;
            samples_.push_back({middle, carried_ / area * facing, carried_});
            carried_ = 0;
            return;
        }
        const glm::dvec3 u = (vertices_[first + 1] - vertices_[first]) / splits;
        const glm::dvec3 v = (vertices_[first + 2] - vertices_[first]) / splits;
        const double share = 1 / (splits * splits);
        for (double i = 0; i < splits; ++i)
            for (double j = 0; i + j < splits; ++j)
                for (const double third : {1.0 / 3, 2.0 / 3}) {
                    // The last cell of each row contains only an upright small triangle, and no inverted one.
                    if (third > 0.5 && i + j + 2 > splits) continue;
                    samples_.push_back(
                        {vertices_[first] + (i + third) * u + (j + third) * v, share * facing, share * area});
                }
    }

    glm::dvec3 extent_{0};
    std::vector<glm::dvec3> vertices_;
    std::vector<Sample> samples_;
    double carried_ = 0;
    double area_ = 0;
    glm::dvec3 middle_{0};
    glm::dvec3 facing_{0};
};

/// The surface area in each voxel of a grid. The area of each sample is distributed to the eight nearest voxels.
class Voxels {
public:
    explicit Voxels(const Surface& surface) : area_(static_cast<std::size_t>(kVoxels * kVoxels * kVoxels)) {
        constexpr double kMargin = 1.1;
        for (const Sample& sample : surface.samples()) {
            const glm::dvec3 at = (sample.at / kMargin + 0.5) * double(kVoxels) - 0.5;
            const glm::dvec3 low = glm::floor(at);
            const glm::dvec3 share = at - low;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::ivec3 one(corner & 1, (corner >> 1) & 1, corner >> 2);
                const glm::dvec3 weight = glm::mix(1.0 - share, share, glm::dvec3(one));
                const glm::ivec3 voxel = glm::ivec3(low) + one;
                area_[index(voxel)] += sample.area * weight.x * weight.y * weight.z / surface.area();
            }
        }
    }

    /// Returns the share of the surface area that coincides with the surface after the transformation `turn`, which
    /// maps voxels to voxels.
    template <class Turn>
    double overlap(const Turn& turn) const {
        double common = 0;
        for (int x = 0; x < kVoxels; ++x)
            for (int y = 0; y < kVoxels; ++y)
                for (int z = 0; z < kVoxels; ++z)
                    common += std::min(area_[index({x, y, z})], area_[index(turn(glm::ivec3(x, y, z)))]);
        return common;
    }

private:
    static std::size_t index(const glm::ivec3& voxel) {
        return (std::size_t(voxel.x) * kVoxels + std::size_t(voxel.y)) * kVoxels + std::size_t(voxel.z);
    }

    std::vector<double> area_;
};

using Features = std::array<double, kUpFeatures>;

/// Computes the features of a surface for one candidate of the up direction.
class Measure {
public:
    Measure(const Surface& surface, int axis, bool isDown)
        : surface_(surface),
          axis_(axis),
          sign_(isDown ? -1 : 1),
          height_(std::max(surface.extent()[axis], kTiny)),
          outline_(hullBelow(2)),
          outlineArea_(std::max(areaOf(outline_), kTiny)) {}

    Features features() {
        measureStand();
        measureArea();
        measureColumns();
        set(UpFeature::Height, surface_.extent()[axis_]);
        set(UpFeature::Slenderness, surface_.extent()[axis_] / std::sqrt(outlineArea_));
        set(UpFeature::Area, surface_.area() / outlineArea_);
        return features_;
    }

private:
    void set(UpFeature feature, double value) { features_[static_cast<std::size_t>(feature)] = value; }

    /// Returns the height of a point relative to the surface, whose bottom is 0 and whose top is 1.
    double heightOf(const glm::dvec3& at) const { return 0.5 + sign_ * at[axis_] / height_; }

    static std::size_t columnOf(const glm::dvec2& at) {
        const glm::ivec2 cell =
            glm::clamp(glm::ivec2(glm::floor((at + 0.5) * double(kColumns))), glm::ivec2(0), glm::ivec2(kColumns - 1));
        return std::size_t(cell.x) * kColumns + std::size_t(cell.y);
    }

    /// Returns the convex hull of all samples below the relative height `height`.
    Outline hullBelow(double height) const {
        Outline points;
        for (const Sample& sample : surface_.samples())
            if (heightOf(sample.at) < height) points.push_back(across(sample.at, axis_));
        return hullOf(std::move(points));
    }

    /// Returns the convex hull of the lowest vertices. Vertices are used because a leg that ends in a point may have no
    /// samples there.
    Outline base() const {
        constexpr double kLowest = 0.02;
        Outline points;
        for (const glm::dvec3& vertex : surface_.vertices())
            if (heightOf(vertex) <= kLowest) points.push_back(across(vertex, axis_));
        return hullOf(std::move(points));
    }

    void measureStand() {
        const Outline base = this->base();
        const glm::dvec2 middle = across(surface_.middle(), axis_);
        const double deepest = depthIn(outline_, middle);
        set(UpFeature::Base, areaOf(base) / outlineArea_);
        set(UpFeature::Balance, deepest > 0 ? std::max(depthIn(base, middle) / deepest, -1.0) : -1);
        set(UpFeature::MiddleHeight, heightOf(surface_.middle()));
        set(UpFeature::Facing, sign_ * surface_.facing()[axis_] / outlineArea_);
        set(UpFeature::LowHull, areaOf(hullBelow(0.25)) / outlineArea_);
    }

    void measureArea() {
        const auto share = [&](UpFeature feature, const auto& isCounted, double whole) {
            double area = 0;
            for (const Sample& sample : surface_.samples())
                if (isCounted(heightOf(sample.at), sign_ * sample.facing[axis_] / sample.area)) area += sample.area;
            set(feature, area / whole);
        };
        const double all = surface_.area();
        share(
            UpFeature::Sole,
            [](double height, double up) { return height < 0.025 && std::abs(up) > kWithin20; },
            outlineArea_);
        share(
            UpFeature::Level, [](double, double up) { return std::abs(up) > kWithin10; }, all);
        share(
            UpFeature::Wall, [](double, double up) { return std::abs(up) < 0.17; }, all);
        share(
            UpFeature::LevelUp, [](double, double up) { return up > kWithin20; }, all);
        share(
            UpFeature::Lowest, [](double height, double) { return height < 0.1; }, all);
        share(
            UpFeature::Low, [](double height, double) { return height >= 0.1 && height < 0.3; }, all);
        share(
            UpFeature::Middle, [](double height, double) { return height >= 0.3 && height < 0.5; }, all);
    }

    Cells cellsBetween(double low, double high) const {
        Cells cells(std::size_t{kColumns} * kColumns);
        for (const Sample& sample : surface_.samples())
            if (const double height = heightOf(sample.at); height >= low && height < high)
                cells[columnOf(across(sample.at, axis_))] = 1;
        return cells;
    }

    void measureColumns() {
        struct Column {
            double lowest = 2;
            bool isLevel = false;
        };

        std::vector<Column> columns(std::size_t{kColumns} * kColumns);
        for (const Sample& sample : surface_.samples()) {
            Column& column = columns[columnOf(across(sample.at, axis_))];
            const double height = heightOf(sample.at);
            if (height < column.lowest) column = {height, std::abs(sample.facing[axis_]) > kWithin20 * sample.area};
        }
        double count = 0;
        double gap = 0;
        double level = 0;
        for (const Column& column : columns) {
            if (column.lowest > 1.5) continue;
            ++count;
            gap += column.lowest;
            level += column.isLevel ? 1 : 0;
        }
        const Cells contact = cellsBetween(-1, 0.03);
        const Cells legs = cellsBetween(0.03, 0.15);
        const Cells body = cellsBetween(0.15, 0.35);
        set(UpFeature::Gap, gap / count);
        set(UpFeature::LevelBelow, level / count);
        set(UpFeature::Contact, countOf(contact) / count);
        set(UpFeature::Feet, partsOf(contact));
        set(UpFeature::LegParts, partsOf(legs));
        set(UpFeature::LegCells, countOf(legs) / count);
        set(UpFeature::BodyParts, partsOf(body));
        set(UpFeature::BodyCells, countOf(body) / count);
    }

    const Surface& surface_;
    int axis_;
    double sign_;
    double height_;
    Outline outline_;
    double outlineArea_;
    Features features_{};
};

} // namespace

std::vector<UpNumbers> upNumbers(std::span<const Corners> triangles) {
    const Surface surface(triangles);
    if (!(surface.area() > 0)) return {};
    const Voxels voxels(surface);
    std::array<Features, kUpDirections> features{};
    for (int direction = 0; direction < kUpDirections; ++direction) {
        const int axis = direction / 2;
        Features& found = features[static_cast<std::size_t>(direction)];
        found = Measure(surface, axis, direction % 2 == 1).features();
        found[static_cast<std::size_t>(UpFeature::Mirror)] = voxels.overlap([axis](glm::ivec3 voxel) {
            voxel[axis] = kVoxels - 1 - voxel[axis];
            return voxel;
        });
        found[static_cast<std::size_t>(UpFeature::Turn)] = voxels.overlap([axis](const glm::ivec3& voxel) {
            glm::ivec3 turned = voxel;
            turned[(axis + 1) % 3] = voxel[(axis + 2) % 3];
            turned[(axis + 2) % 3] = kVoxels - 1 - voxel[(axis + 1) % 3];
            return turned;
        });
    }
    std::vector<UpNumbers> numbers(kUpDirections);
    for (std::size_t direction = 0; direction < kUpDirections; ++direction)
        for (std::size_t i = 0; i < kUpFeatures; ++i) {
            const double own = features[direction][i];
            double largest = -std::numeric_limits<double>::infinity();
            double smallest = -largest;
            for (std::size_t other = 0; other < kUpDirections; ++other) {
                if (other / 2 == direction / 2) continue;
                largest = std::max(largest, features[other][i]);
                smallest = std::min(smallest, features[other][i]);
            }
            numbers[direction][4 * i] = static_cast<float>(own);
            numbers[direction][4 * i + 1] = static_cast<float>(own - features[direction ^ 1U][i]);
            numbers[direction][4 * i + 2] = static_cast<float>(own - largest);
            numbers[direction][4 * i + 3] = static_cast<float>(own - smallest);
        }
    return numbers;
}

} // namespace gnomon::hierarchy
