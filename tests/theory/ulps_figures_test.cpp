// What `gnomon theory figures` shows of the errors of closed forms is what they have.
#include "tests/theory/ulps_table.h"
#include "theory/embedded_files.h"
#include "theory/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

namespace gnomon::theory {
namespace {

Figure asFigure(const UlpsTable& table) {
    Figure figure;
    figure.columns = {"exponent"};
    figure.columns.insert(figure.columns.end(), table.columns.begin(), table.columns.end());
    for (std::size_t i = 0; i < table.worst.size(); ++i) {
        std::vector<double> row{static_cast<double>(table.firstExponent) + static_cast<double>(i)};
        for (const double worst : table.worst[i])
            row.push_back(std::ceil(worst * 100) / 100);
        figure.rows.push_back(row);
    }
    return figure;
}

/// Draws of a seed begin with those of fewer draws: none may be worse than what is shown. With GNOMON_ULPS_TABLE, the
/// name of a file, the table is made of 60,000 draws and written there (data/figures/ulps.csv).
TEST(UlpsFigures, ShowNoLessThanDrawsFind) {
    if (const char* path = std::getenv("GNOMON_ULPS_TABLE"); path != nullptr) {
        std::ofstream(path) << csvOf(asFigure(ulpsTable(60000)));
        return;
    }
    std::map<std::pair<std::string, int>, double> shown;
    for (const Figure& figure : ulpsFigures())
        for (const std::vector<double>& row : figure.rows)
            for (std::size_t i = 1; i < row.size(); ++i)
                shown[{figure.columns[i], static_cast<int>(std::lround(std::log10(row[0])))}] = row[i] - 0.5;
    const UlpsTable table = ulpsTable(300);
    for (std::size_t i = 0; i < table.worst.size(); ++i)
        for (std::size_t j = 0; j < table.columns.size(); ++j) {
            if (std::isnan(table.worst[i][j])) continue;
            const auto found = shown.find({table.columns[j], table.firstExponent + static_cast<int>(i)});
            ASSERT_NE(found, shown.end()) << table.columns[j];
            EXPECT_LE(table.worst[i][j], found->second * (1 + 1e-9) + 1e-9) << table.columns[j] << " at " << i;
        }
}

TEST(UlpsFigures, AreOfAllFormsOfAViewAndInOrder) {
    std::size_t columns = 0;
    for (const Figure& figure : ulpsFigures()) {
        EXPECT_EQ(figure.rows.size(), 15U);
        EXPECT_GE(figure.columns.size(), 5U);
        columns += figure.columns.size() - 1;
        for (const std::vector<double>& row : figure.rows)
            ASSERT_EQ(row.size(), figure.columns.size());
    }
    EXPECT_EQ(columns, ulpsTable(0).columns.size());
}

} // namespace
} // namespace gnomon::theory
