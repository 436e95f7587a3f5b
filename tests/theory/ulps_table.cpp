#include "tests/theory/ulps_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace gnomon::theory {

namespace {

constexpr int kFirst = -6;
constexpr std::size_t kPowers = 15; // 1e-6 to 1e8

/// Of the closed forms those of a view; the other has no depth ratio.
bool isOfView(const ClosedForm& form) {
    return std::strcmp(form.name, "kappa of a fit") != 0;
}

std::size_t powerOf(const Doubles& in) {
    const double exponent = std::floor(std::log10((in[1] - in[0]) / in[0]) + 1e-6); // 1e-6 itself is rounded
    return static_cast<std::size_t>(std::clamp<double>(exponent - kFirst, 0, kPowers - 1));
}

} // namespace

double ulpsOff(double found, const Real& exact) {
    const double near = exact.rounded();
    if (!exact.isFinite()) return found == near ? 0 : INFINITY;
    const double next = std::nextafter(std::abs(near), INFINITY) - std::abs(near);
    return (magnitude(Real(found) - exact) / next).rounded();
}

UlpsTable ulpsTable(int samples) {
    UlpsTable table{kFirst};
    table.worst.resize(kPowers);
    for (const ClosedForm& form : closedFormsWithTwins()) {
        if (!isOfView(form)) continue;
        const std::size_t first = table.columns.size();
        for (const char* output : form.outputs) {
            std::string column = std::string(form.name) + ": " + output;
            column.erase(std::remove(column.begin(), column.end(), ','), column.end());
            table.columns.push_back(column);
        }
        for (auto& row : table.worst)
            row.resize(table.columns.size(), std::numeric_limits<double>::quiet_NaN());
        Random random(1);
        for (int i = 0; i < samples; ++i) {
            const Doubles in = form.draw(random);
            const Doubles ours = form.ours(in);
            const Reals exact = form.exact({in.begin(), in.end()});
            std::vector<double>& row = table.worst[powerOf(in)];
            for (std::size_t j = 0; j < ours.size(); ++j)
                row[first + j] = std::fmax(row[first + j], ulpsOff(ours[j], exact[j]));
        }
    }
    return table;
}

} // namespace gnomon::theory
