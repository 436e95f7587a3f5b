#include "tests/pictures/painted_wall.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <vector>

namespace gnomon::tests {

namespace {

using Color = std::array<std::uint8_t, 3>;

/// Letters of five by seven cells, a row a byte.
constexpr std::array<std::array<std::uint8_t, 7>, 6> kLetters = {
    {{0x0E, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0F},   // G
     {0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11},   // N
     {0x0E, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0E},   // O
     {0x11, 0x1B, 0x15, 0x15, 0x11, 0x11, 0x11},   // M
     {0x0E, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0E},   // O
     {0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11}}}; // N

class Wall {
public:
    explicit Wall(std::uint32_t side) : side_(side), colors_(std::size_t{side + 1} * (side + 1)) {
        const std::uint32_t third = side / 3;
        for (std::uint32_t row = 0; row <= side; ++row)
            for (std::uint32_t column = 0; column <= side; ++column)
                at(column, row) = row < third ? gradient(column, row) : row < 2 * third ? checker(column, row) : kPaper;
        std::uint32_t row = 2 * third + 4;
        for (const std::uint32_t cell : {1U, 2U, 3U, 5U, 9U}) {
            writeLine(row, cell);
            row += 9 * cell;
        }
    }

    const Color& colorOf(std::uint32_t column, std::uint32_t row) const {
        return colors_[std::size_t{row} * (side_ + 1) + column];
    }

private:
    static constexpr Color kPaper = {242, 242, 230};
    static constexpr Color kInk = {13, 13, 26};

    Color& at(std::uint32_t column, std::uint32_t row) { return colors_[std::size_t{row} * (side_ + 1) + column]; }

    Color gradient(std::uint32_t column, std::uint32_t row) const {
        const auto ramp = [&](std::uint32_t n) { return static_cast<std::uint8_t>(40 + 180 * n / side_); };
        return {ramp(column), ramp(row), static_cast<std::uint8_t>(220 - ramp(column) / 2)};
    }

    Color checker(std::uint32_t column, std::uint32_t row) const {
        const std::uint32_t size = column < side_ / 3 ? 2 : column < 2 * side_ / 3 ? 8 : 30;
        return (column / size + row / size) % 2 == 0 ? Color{230, 217, 51} : Color{26, 51, 153};
    }

    void writeLine(std::uint32_t top, std::uint32_t cell) {
        std::uint32_t letter = 0;
        for (std::uint32_t left = 4; left + 6 * cell < side_; left += 6 * cell, ++letter)
            for (std::uint32_t i = 0; i < 7 * cell && top + i <= side_; ++i)
                for (std::uint32_t j = 0; j < 5 * cell; ++j)
                    if ((kLetters[letter % kLetters.size()][i / cell] >> (4 - j / cell) & 1U) != 0)
                        at(left + j, top + i) = kInk;
    }

    std::uint32_t side_;
    std::vector<Color> colors_;
};

template <class T>
void put(std::ofstream& out, const T& value) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    out.write(bytes.data(), bytes.size());
}

} // namespace

void writePaintedWall(std::uint32_t side, const std::string& path) {
    const Wall wall(side);
    std::ofstream out(path, std::ios::binary);
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << (side + 1) * (side + 1)
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nelement face "
        << side * side << "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (std::uint32_t row = 0; row <= side; ++row)
        for (std::uint32_t column = 0; column <= side; ++column) {
            const auto across = static_cast<float>(column);
            put(out,
                std::array<float, 3>{across, static_cast<float>(side - row), across * 0.375F}); // no view is along it
            put(out, wall.colorOf(column, row));
        }
    for (std::uint32_t row = 0; row < side; ++row)
        for (std::uint32_t column = 0; column < side; ++column) {
            const std::uint32_t a = row * (side + 1) + column;
            put(out, std::uint8_t{4});
            put(out, std::array<std::uint32_t, 4>{a, a + side + 1, a + side + 2, a + 1});
        }
}

} // namespace gnomon::tests
