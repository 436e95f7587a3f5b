// Computes the data of the figures of Lloyd et al. 2006 and of additional figures, for `gnomon theory figures`. Each
// figure has one table.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gnomon::theory {

/// A figure of the shadow theory: a table of data and its presentation.
struct Figure {
    /// The type of a plot. Lines: column 0 of the table is x, and each other column is a series. Curves: rows are
    /// (panel, curve, x, y), and each curve is a polyline. Maps: rows are (panel, x, y, value). Each panel is a
    /// coloured disc of light directions seen from above, with directions behind the viewer on the left.
    enum class Kind { Lines, Curves, Maps };

    std::string name{}; // file name without extension
    Kind kind = Kind::Lines;
    std::string title{};
    std::string caption{}; // includes the parameters
    std::string xLabel{};
    std::string yLabel{};
    bool logX = false;
    bool logY = false;
    std::vector<std::string> panels{}; // for curves and maps: the panel names, indexed by column 0
    std::vector<std::string> columns{};
    std::vector<std::vector<double>> rows{}; // NaN is an empty cell
};

/// Returns the recomputed data of figures 2, 4, 5, 6, 7, 10 and 12 of Lloyd et al. 2006.
std::vector<Figure> paperFigures();

/// Returns the figures that Lloyd et al. 2006 does not contain: warp rules over the hemisphere, exact forms of Eqs 20
/// and 21, the storage factor S up to k = 20 slices, lambda, and orientation.
std::vector<Figure> ownFigures();

/// Returns figures with the errors of the closed forms of src/shadow, by depth ratio. The data come from the table of
/// the tests (tests/theory/ulps_table.h), with 60,000 random inputs each.
std::vector<Figure> ulpsFigures();

/// Returns the table of a figure as CSV with a header line.
std::string csvOf(const Figure& figure);

} // namespace gnomon::theory
