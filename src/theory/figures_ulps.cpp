#include "theory/embedded_files.h"
#include "theory/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

namespace gnomon::theory {

namespace {

struct UlpsFamily {
    const char* name;
    const char* title;
    std::vector<std::string_view> forms;
};

const std::array kUlpsFamilies{
    UlpsFamily{
        "own7_ulps_overhead",
        "Error of the closed forms: one map under a light overhead",
        {"one map overhead", "S overhead n' < n", "point overhead", "n' of eta", "eta of n'", "n' of a TSM"}},
    UlpsFamily{
        "own8_ulps_schemes",
        "Error of the closed forms: slices, schemes and logarithmic maps",
        {"slices", "schemes", "large ratios", "stable extent", "logarithmic sums"}},
    UlpsFamily{"own9_ulps_any_light", "Error of the closed forms: one map under any light", {"any light", "kappa"}},
    UlpsFamily{"own10_ulps_points", "Error of the closed forms: a point in its map", {"point of a map"}},
};

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream words(line + ",");
    for (std::string cell; std::getline(words, cell, ',');)
        cells.push_back(cell);
    return cells;
}

bool isOfFamily(const UlpsFamily& family, std::string_view column) {
    const std::string_view form = column.substr(0, column.find(':'));
    return std::find(family.forms.begin(), family.forms.end(), form) != family.forms.end();
}

Figure ulpsFigure(const UlpsFamily& family, const std::vector<std::vector<std::string>>& table) {
    Figure figure{family.name, Figure::Kind::Lines, family.title, {}, {}, {}};
    figure.caption =
        "Worst error of 60,000 draws from the whole domain in each power of ten of f/n - 1, against a twin of 200 bits;"
        " half a unit is added, so that 0 can be seen. Above 64 units it is within the condition number of the inputs.";
    figure.xLabel = "f/n - 1, at least";
    figure.yLabel = "units in the last place, and a half";
    figure.logX = figure.logY = true;
    figure.columns = {"f/n - 1"};
    std::vector<std::size_t> taken;
    for (std::size_t i = 1; i < table[0].size(); ++i) {
        if (!isOfFamily(family, table[0][i])) continue;
        taken.push_back(i);
        figure.columns.push_back(table[0][i]);
    }
    for (std::size_t i = 1; i < table.size(); ++i) {
        std::vector<double> row{std::pow(10, std::stod(table[i][0]))};
        for (const std::size_t column : taken)
            row.push_back(table[i][column].empty() ? NAN : std::stod(table[i][column]) + 0.5);
        figure.rows.push_back(std::move(row));
    }
    return figure;
}

} // namespace

std::vector<Figure> ulpsFigures() {
    std::vector<std::vector<std::string>> table;
    std::istringstream lines{std::string(kUlpsTable)};
    for (std::string line; std::getline(lines, line);)
        table.push_back(cellsOf(line));
    std::vector<Figure> figures;
    figures.reserve(kUlpsFamilies.size());
    for (const UlpsFamily& family : kUlpsFamilies)
        figures.push_back(ulpsFigure(family, table));
    return figures;
}

} // namespace gnomon::theory
