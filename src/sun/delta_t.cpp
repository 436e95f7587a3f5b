#include "sun/delta_t.h"

#include <array>
#include <span>

#include <erfa.h>

namespace gnomon::sun {
namespace {

constexpr double kTerrestrialTimeMinusAtomic = 32.184; // seconds

// A polynomial for delta T in (year - origin) / unit, lowest power first. It is valid for years before `until`.
struct Span {
    double until;
    double origin;
    double unit;
    std::array<double, 8> coefficients;
};

constexpr std::array<Span, 12> kSpans{{
    {500, 0, 100, {10583.6, -1014.41, 33.78311, -5.952053, -0.1798452, 0.022174192, 0.0090316521}},
    {1600, 1000, 100, {1574.2, -556.01, 71.23472, 0.319781, -0.8503463, -0.005050998, 0.0083572073}},
    {1700, 1600, 1, {120, -0.9808, -0.01532, 1.0 / 7129}},
    {1800, 1700, 1, {8.83, 0.1603, -0.0059285, 0.00013336, -1.0 / 1174000}},
    {1860, 1800, 1, {13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272, -0.0000001699, 0.000000000875}},
    {1900, 1860, 1, {7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1.0 / 233174}},
    {1920, 1900, 1, {-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197}},
    {1941, 1920, 1, {21.20, 0.84493, -0.076100, 0.0020936}},
    {1961, 1950, 1, {29.07, 0.407, -1.0 / 233, 1.0 / 2547}},
    {1986, 1975, 1, {45.45, 1.067, -1.0 / 260, -1.0 / 718}},
    {2005, 2000, 1, {63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599}},
    {2050, 2000, 1, {62.92, 0.32217, 0.005589}},
}};

double polynomial(std::span<const double> coefficients, double x) {
    double value = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;)
        value = value * x + coefficients[i];
    return value;
}

double modelled(double year) {
    for (const Span& span : kSpans) {
        if (year < span.until) return polynomial(span.coefficients, (year - span.origin) / span.unit);
    }
    const double parabola = polynomial(std::array{-20.0, 0.0, 32.0}, (year - 1820) / 100);
    return year < 2150 ? parabola - 0.5628 * (2150 - year) : parabola;
}

} // namespace

double deltaT(const JulianDate& date) {
    int year = 0;
    int month = 0;
    int day = 0;
    double fraction = 0;
    eraJd2cal(date.midnight, date.fraction, &year, &month, &day, &fraction);
    double leapSeconds = 0;
    if (year >= 1972 && year <= kLastYearOfLeapSeconds && eraDat(year, month, day, fraction, &leapSeconds) >= 0)
        return kTerrestrialTimeMinusAtomic + leapSeconds;
    return modelled(year + (month - 0.5) / 12);
}

} // namespace gnomon::sun
