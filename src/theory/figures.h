// `gnomon theory figures`: the data behind the paper's figures and behind this project's own, one table each.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gnomon::theory {

/// One figure: a table and how it is meant to be seen.
struct Figure {
    /// lines: column 0 is x, each other column a series. curves: (panel, curve, x, y), each curve a polyline.
    /// maps: (panel, x, y, value), each panel a coloured disc of light directions seen from overhead, behind the viewer
    /// on the left.
    enum class Kind { Lines, Curves, Maps };

    std::string name{}; // of its files, without extension
    Kind kind = Kind::Lines;
    std::string title{};
    std::string caption{}; // states the parameters
    std::string xLabel{};
    std::string yLabel{};
    bool logX = false;
    bool logY = false;
    std::vector<std::string> panels{}; // curves and maps: what the numbers of column 0 stand for
    std::vector<std::string> columns{};
    std::vector<std::vector<double>> rows{}; // NaN is an empty cell
};

/// Figures 2, 4, 5, 6, 7, 10 and 12 of Lloyd et al. 2006, recomputed.
std::vector<Figure> paperFigures();

/// What the paper does not have: warp rules over the hemisphere, Eqs 20 and 21 exactly, S to k = 20, lambda,
/// orientation.
std::vector<Figure> ownFigures();

/// How far the closed forms of src/shadow are off, over the depth ratio: from the table that the tests made
/// (tests/theory/ulps_table.h), at 60,000 draws each.
std::vector<Figure> ulpsFigures();

/// The table as CSV with a header line.
std::string csvOf(const Figure& figure);

} // namespace gnomon::theory
