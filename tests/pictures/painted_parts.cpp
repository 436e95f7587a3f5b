#include "tests/pictures/painted_parts.h"

#include "core/random.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

namespace gnomon::tests {

namespace {

using Point = std::array<double, 3>;
using Color = PaintedMesh::Color;

constexpr Color kYellow = {240, 200, 30};
constexpr Color kBlue = {25, 60, 170};
constexpr Color kGrey = {120, 120, 120};
constexpr Color kWhite = {240, 240, 240};
constexpr Color kRed = {180, 50, 40};
constexpr Color kDark = {40, 40, 50};

Point operator+(const Point& a, const Point& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Point operator-(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point operator*(const Point& a, double s) {
    return {a[0] * s, a[1] * s, a[2] * s};
}

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Point& a) {
    return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/// Adds parts to a mesh; each face has vertices of its own.
class Builder {
public:
    explicit Builder(double scale) : cellScale_(scale) {}

    /// A parallelogram from `origin` along `u` and `v`, in `columns` x `rows` squares; it faces along u x v.
    void addSheet(const Point& origin, const Point& u, const Point& v, int columns, int rows, const Color& color) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int row = 0; row <= rows; ++row)
            for (int column = 0; column <= columns; ++column)
                addVertex(origin + u * (double(column) / columns) + v * (double(row) / rows), color);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const auto a = first + static_cast<std::uint32_t>(row * (columns + 1) + column);
                const auto d = a + static_cast<std::uint32_t>(columns + 1);
                mesh.triangles.push_back({a, a + 1, d + 1});
                mesh.triangles.push_back({a, d + 1, d});
            }
    }

    /// A box from `low` to `high` whose faces have squares of about `cell`.
    void addBox(const Point& low, const Point& high, double cell, const Color& color) {
        const Point x{high[0] - low[0], 0, 0};
        const Point y{0, high[1] - low[1], 0};
        const Point z{0, 0, high[2] - low[2]};
        const auto cells = [&](const Point& side) {
            return std::max(1, static_cast<int>(length(side) / (cell * cellScale_)));
        };
        const int nx = cells(x);
        const int ny = cells(y);
        const int nz = cells(z);
        addSheet(low, y, x, ny, nx, color);
        addSheet(low + z, x, y, nx, ny, color);
        addSheet(low, x, z, nx, nz, color);
        addSheet(low + y, z, x, nz, nx, color);
        addSheet(low, z, y, nz, ny, color);
        addSheet(low + x, y, z, ny, nz, color);
    }

    /// An open tube from `a` to `b` with `sides` flat sides, in `segments` segments.
    void addTube(const Point& a, const Point& b, double radius, int sides, int segments, const Color& color) {
        const Point axis = b - a;
        Point across = cross(axis, std::abs(axis[2]) < 0.9 * length(axis) ? Point{0, 0, 1} : Point{1, 0, 0});
        across = across * (radius / length(across));
        Point upright = cross(axis, across);
        upright = upright * (radius / length(upright));
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int s = 0; s <= segments; ++s)
            for (int k = 0; k < sides; ++k) {
                const double angle = 2 * 3.141592653589793 * k / sides;
                const Point rim = across * std::cos(angle) + upright * std::sin(angle);
                addVertex(a + axis * (double(s) / segments) + rim, color);
            }
        for (int s = 0; s < segments; ++s)
            for (int k = 0; k < sides; ++k) {
                const auto at = [&](int segment, int side) {
                    return first + static_cast<std::uint32_t>(segment * sides + side % sides);
                };
                mesh.triangles.push_back({at(s, k), at(s, k + 1), at(s + 1, k + 1)});
                mesh.triangles.push_back({at(s, k), at(s + 1, k + 1), at(s + 1, k)});
            }
    }

    PaintedMesh mesh;

private:
    double cellScale_;

    void addVertex(const Point& p, const Color& color) {
        mesh.positions.push_back(p);
        mesh.colors.push_back(color);
    }
};

/// The girder of one side at `y`: an I of three plates, posts, diagonals and bolts.
void addGirder(Builder& b, double y, double x, double bay) {
    b.addBox({x, y - 0.25, 4.0}, {x + bay, y + 0.25, 4.04}, 0.25, kYellow);
    b.addBox({x, y - 0.02, 0.04}, {x + bay, y + 0.02, 0.8}, 0.25, kYellow);
    b.addBox({x, y - 0.25, 0.0}, {x + bay, y + 0.25, 0.04}, 0.25, kYellow);
    b.addBox({x - 0.1, y - 0.1, 0.04}, {x + 0.1, y + 0.1, 4.0}, 0.2, kBlue);
    b.addTube({x, y, 0.4}, {x + bay / 2, y, 4}, 0.08, 12, 24, kYellow);
    b.addTube({x + bay / 2, y, 4}, {x + bay, y, 0.4}, 0.08, 12, 24, kBlue);
    for (int i = 0; i < 24; ++i) {
        const double at = x + bay * (i + 0.5) / 24;
        b.addTube({at, y - 0.15, 4.04}, {at, y - 0.15, 4.08}, 0.03, 8, 1, kDark);
        b.addTube({at, y + 0.15, 4.04}, {at, y + 0.15, 4.08}, 0.03, 8, 1, kBlue);
    }
}

/// Posts and rails along `y`, and a kick plate in front of the deck's edge.
void addRailing(Builder& b, double y, double x, double bay) {
    for (int i = 0; i < 8; ++i) {
        const double at = x + bay * (i + 0.5) / 8;
        b.addTube({at, y, 1.0}, {at, y, 2.1}, 0.03, 8, 8, kBlue);
    }
    for (const double z : {1.3, 1.7, 2.1})
        b.addTube({x, y, z}, {x + bay, y, z}, 0.025, 8, 32, z > 2 ? kYellow : kBlue);
    b.addBox({x, y - 0.035, 1.0}, {x + bay, y - 0.015, 1.15}, 0.15, kYellow);
}

/// The slab, the sheets on it with their stripes, and beams below.
void addDeck(Builder& b, double x, double bay) {
    b.addBox({x, -4, 0.8}, {x + bay, 4, 0.95}, 0.4, kBlue);
    b.addBox({x, -3.5, 0.95}, {x + bay, 3.5, 1.0}, 0.25, kGrey);
    b.addSheet({x, -0.1, 1.003}, {bay / 2, 0, 0}, {0, 0.2, 0}, 16, 1, kYellow);
    for (const double y : {-3.3, 3.15})
        b.addSheet({x, y, 1.003}, {bay, 0, 0}, {0, 0.15, 0}, 32, 1, kWhite);
    for (int i = 0; i < 4; ++i) {
        const double at = x + bay * (i + 0.5) / 4;
        b.addBox({at - 0.1, -4, 0.5}, {at + 0.1, 4, 0.8}, 0.2, i % 2 == 0 ? kYellow : kBlue);
    }
    b.addBox({x, -3.98, 0.79}, {x + bay, 3.98, 0.8}, 0.4, kYellow); // a sheet of 1 cm inside the beams' height
}

void addWalls(Builder& b, const Point& low, const Point& high, const Color& wall, Random& random) {
    b.addBox(low, high, 0.8, wall);
    const int floors = static_cast<int>((high[2] - low[2]) / 3);
    const Color frame = random.below(2) == 0 ? kWhite : kDark;
    for (int f = 0; f < floors; ++f)
        for (int i = 0; i < 4; ++i) {
            const double x = low[0] + (high[0] - low[0]) * (i + 0.3) / 4;
            const double z = low[2] + 3.0 * f + 1;
            b.addBox({x, low[1] - 0.05, z}, {x + 1, low[1], z + 1.4}, 0.5, frame);
            b.addBox({x + 0.1, low[1] - 0.07, z + 0.1}, {x + 0.9, low[1] - 0.05, z + 1.3}, 0.5, kBlue);
        }
}

void addRoof(Builder& b, const Point& low, const Point& high, Random& random) {
    constexpr std::array<Color, 6> kRoofs = {kRed, kGrey, kYellow, kBlue, kDark, Color{70, 140, 70}};
    double z = high[2];
    const auto layers = 2 + random.below(3);
    for (std::uint64_t i = 0; i < layers; ++i) {
        constexpr std::array<double, 4> kThick = {0.01, 0.03, 0.08, 0.2};
        const double inset = 0.15 * static_cast<double>(i);
        const double top = z + kThick[random.below(4)];
        b.addBox(
            {low[0] + inset, low[1] + inset, z},
            {high[0] - inset, high[1] - inset, top},
            0.5,
            kRoofs[random.below(kRoofs.size())]);
        z = top;
    }
    for (int i = 0; i < 3; ++i) {
        const double x = low[0] + 1 + 2.5 * i;
        b.addTube({x, low[1] + 2, z}, {x, low[1] + 2, z + 1}, 0.15, 12, 4, kRed);
        b.addSheet({x, low[1] + 4, z + 0.02}, {1.6, 0, 0}, {0, 3, 0}, 4, 8, kDark);
    }
}

} // namespace

PaintedMesh paintedBridge(std::uint32_t bays, double cellScale) {
    constexpr double kBay = 8;
    Builder b(cellScale);
    for (std::uint32_t i = 0; i < bays; ++i) {
        const double x = kBay * i;
        for (const double y : {-4.2, 4.2})
            addGirder(b, y, x, kBay);
        for (const double y : {-3.8, 3.8})
            addRailing(b, y, x, kBay);
        addDeck(b, x, kBay);
    }
    return b.mesh;
}

PaintedMesh paintedCity(std::uint32_t side, double cellScale) {
    Builder b(cellScale);
    Random random(1);
    const double extent = side * 11.0;
    b.addSheet(
        {-4, -4, 0}, {extent, 0, 0}, {0, extent, 0}, static_cast<int>(2 * side), static_cast<int>(2 * side), kGrey);
    for (std::uint32_t row = 0; row < side; ++row)
        for (std::uint32_t column = 0; column < side; ++column) {
            constexpr std::array<Color, 4> kWalls = {kWhite, kRed, Color{200, 180, 140}, kYellow};
            const double gap = column % 3 == 2 ? 0 : 2; // two of three houses adjoin the next one
            const Point low{column * 10.0, row * 11.0, 0};
            const Point high{low[0] + 10 - gap, low[1] + 8, 3.0 * static_cast<double>(1 + random.below(4))};
            addWalls(b, low, high, kWalls[random.below(4)], random);
            addRoof(b, low, high, random);
            b.addSheet({low[0], low[1] - 1.6, 0.005}, {10, 0, 0}, {0, 0.2, 0}, 20, 1, kWhite);
        }
    return b.mesh;
}

PaintedMesh welded(const PaintedMesh& mesh) {
    PaintedMesh result;
    std::map<std::array<float, 3>, std::uint32_t> vertexAt;
    std::vector<std::uint32_t> vertexOf;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Point& p = mesh.positions[v];
        const std::array<float, 3> key{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
        const auto next = static_cast<std::uint32_t>(result.positions.size());
        const auto [found, isNew] = vertexAt.try_emplace(key, next);
        vertexOf.push_back(found->second);
        if (!isNew) continue;
        result.positions.push_back(p);
        result.colors.push_back(mesh.colors[v]);
    }
    for (const auto& t : mesh.triangles)
        result.triangles.push_back({vertexOf[t[0]], vertexOf[t[1]], vertexOf[t[2]]});
    return result;
}

void writePainted(const PaintedMesh& mesh, const std::string& path) {
    std::ofstream out(path, std::ios::binary);
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.positions.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nelement face "
        << mesh.triangles.size() << "\nproperty list uchar uint vertex_indices\nend_header\n";
    const auto put = [&](const auto& value) {
        std::array<char, sizeof(value)> bytes{};
        std::memcpy(bytes.data(), &value, sizeof(value));
        out.write(bytes.data(), bytes.size());
    };
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (const double x : mesh.positions[v])
            put(static_cast<float>(x));
        put(mesh.colors[v]);
    }
    for (const auto& t : mesh.triangles) {
        put(std::uint8_t{3});
        put(t);
    }
}

} // namespace gnomon::tests
