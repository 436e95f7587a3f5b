// Generated models of many thin parts with different colours, in contact and in layers: a bridge and a city.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tests {

/// A triangle mesh with one colour per vertex.
struct PaintedMesh {
    using Color = std::array<std::uint8_t, 3>;

    std::vector<std::array<double, 3>> positions;
    std::vector<Color> colors;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Returns a bridge of `bays` bays of 8 m: yellow girders with bolts, a blue deck in layers, stripes and railings.
/// Faces are divided into cells of about 20 cm times `cellScale`.
PaintedMesh paintedBridge(std::uint32_t bays, double cellScale);

/// Returns a city of `side` x `side` houses with adjoining walls, windows, and roofs in layers that are 1 to 20 cm
/// apart. Faces are divided into cells of about 50 cm times `cellScale`.
PaintedMesh paintedCity(std::uint32_t side, double cellScale);

/// Merges vertices at equal positions. The first vertex of a position gives its colour, so colours mix at contacts.
PaintedMesh welded(const PaintedMesh& mesh);

/// Writes `mesh` as a PLY with a colour per vertex.
void writePainted(const PaintedMesh& mesh, const std::string& path);

} // namespace gnomon::tests
