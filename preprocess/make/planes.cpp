#include "preprocess/make/planes.h"

#include "core/check.h"
#include "preprocess/make/noise.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

using glm::dvec3;

namespace {

/// A cross-section of an aeroplane's fuselage at the position `z`. It extends from `low` to `high` in y. `width` is
/// half its width.
struct Section {
    double z = 0;
    double width = 0;
    double low = 0;
    double high = 0;
};

/// The cross-sections of the fuselage from the tail to the back plate of the spinner. The nose points along +z.
constexpr std::array<Section, 10> kFuselage{{
    {-5.6, 0.02, 0.20, 0.28},
    {-5.0, 0.10, -0.02, 0.36},
    {-3.6, 0.24, -0.28, 0.46},
    {-2.0, 0.36, -0.48, 0.58},
    {-0.6, 0.44, -0.62, 0.66},
    {0.8, 0.47, -0.66, 0.60},
    {1.9, 0.45, -0.58, 0.54},
    {2.9, 0.42, -0.50, 0.50},
    {3.6, 0.36, -0.40, 0.42},
    {3.8, 0.30, -0.30, 0.30},
}};

/// Returns the cross-section of the fuselage at `u`, from 0 at the tail to 1 at the nose. It interpolates kFuselage
/// with a spline (Catmull, Rom 1974).
Section sectionAt(double u) {
    const double x = u * static_cast<double>(kFuselage.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(x), kFuselage.size() - 2);
    const double t = x - static_cast<double>(i);
    const Section& a = kFuselage.at(i == 0 ? 0 : i - 1);
    const Section& b = kFuselage.at(i);
    const Section& c = kFuselage.at(i + 1);
    const Section& d = kFuselage.at(std::min(i + 2, kFuselage.size() - 1));
    const auto spline = [&](double Section::*m) {
        return b.*m +
               0.5 * t *
                   (c.*m - a.*m + t * (2 * a.*m - 5 * b.*m + 4 * c.*m - d.*m + t * (3 * (b.*m - c.*m) + d.*m - a.*m)));
    };
    return {spline(&Section::z), spline(&Section::width), spline(&Section::low), spline(&Section::high)};
}

/// Returns half the thickness of a symmetric four-digit NACA wing section at the position `x` of its chord, from 0 to
/// 1. The max thickness of the section is scaled to 1. The section is closed at both ends.
double nacaHalfThickness(double x) {
    return std::max(0.0, 5 * (0.2969 * std::sqrt(x) - x * (0.1260 + x * (0.3516 - x * (0.2843 - x * 0.1036)))));
}

/// A wing, a tailplane or a fin of an aeroplane. Its sections follow each other along `span`. Their chords extend from
/// the leading edge to -z.
struct Foil {
    dvec3 root{0};  // root end of the leading edge
    dvec3 span{0};  // from the root end to the tip of the leading edge
    dvec3 thick{0}; // unit normal of the foil's plane, in the direction z x span
    double rootChord = 1;
    double tipChord = 1;
    double thickness = 0.12;
};

class PlaneBuilder {
public:
    PlaneBuilder(PartSink& parts, double fineness) : parts_(parts), fineness_(fineness) {}

    void addPlane(double propellerTurns) {
        addFuselage();
        addFoils();
        addDetails();
        addPropeller(propellerTurns);
    }

private:
    std::uint64_t steps(double base, std::uint64_t minSteps) const {
        return std::max(minSteps, static_cast<std::uint64_t>(std::llround(base * fineness_)));
    }

    void addFoil(const Foil& foil, double rings, double around) {
        addSkin(parts_, steps(rings, 3), steps(around, 6), [&](double u, double v) {
            const double taper = foil.rootChord + (foil.tipChord - foil.rootChord) * u;
            const double tip = std::max(0.0, u - 0.9) * 10; // the last tenth of the span is rounded
            const double chord = taper * std::sqrt(std::max(0.02, 1 - tip * tip));
            const double x = 0.5 + 0.5 * cosTurns(v);
            const double side = v < 0.5 ? 1 : -1;
            const dvec3 edge = foil.root + foil.span * u - dvec3(0, 0, 0.35 * (taper - chord));
            return edge - dvec3(0, 0, x * chord) + foil.thick * (side * foil.thickness * chord * nacaHalfThickness(x));
        });
    }

    void addFuselage() {
        addSkin(parts_, steps(70, 6), steps(46, 6), [](double u, double v) {
            const Section s = sectionAt(u);
            const double up = sinTurns(v);
            const double half = up > 0 ? s.high : -s.low;
            return dvec3(s.width * cosTurns(v), up * half, s.z);
        });
        // The first call adds the bubble canopy. The second call adds the radiator below the fuselage.
        addSkin(parts_, steps(26, 4), steps(24, 6), [](double u, double v) {
            const double r = std::sqrt(std::max(0.004, 1 - (2 * u - 1) * (2 * u - 1)));
            return dvec3(0.33 * r * cosTurns(v), 0.58 + 0.46 * r * sinTurns(v), -1.4 + 2.5 * u);
        });
        addSkin(parts_, steps(22, 4), steps(20, 6), [](double u, double v) {
            const double r = std::sqrt(std::max(0.03, 1 - (2 * u - 1) * (2 * u - 1)));
            return dvec3(0.27 * r * cosTurns(v), -0.62 + 0.30 * r * sinTurns(v), -2.4 + 2.6 * u);
        });
    }

    void addFoils() {
        for (const double side : {1.0, -1.0}) {
            const dvec3 wingSpan(side * 5.2, 0.45, -0.35);
            addFoil(
                {{side * 0.25, -0.42, 1.3},
                 wingSpan,
                 glm::normalize(glm::cross(dvec3(0, 0, 1), wingSpan)),
                 2.5,
                 1.2,
                 0.15},
                42,
                38);
            const dvec3 tailSpan(side * 1.9, 0.05, -0.3);
            addFoil(
                {{side * 0.08, 0.26, -3.9},
                 tailSpan,
                 glm::normalize(glm::cross(dvec3(0, 0, 1), tailSpan)),
                 1.2,
                 0.7,
                 0.10},
                18,
                24);
        }
        addFoil({{0, 0.30, -3.5}, {0, 1.35, -0.75}, {-1, 0, 0}, 1.7, 0.8, 0.10}, 18, 24);
    }

    void addDetails() {
        for (const double side : {1.0, -1.0}) {
            for (int i = 0; i < 6; ++i) { // exhaust stubs
                const dvec3 at(side * 0.40, 0.22, 3.2 - 0.24 * i);
                addRod(parts_, at, at + dvec3(side * 0.16, 0.02, -0.12), 0.05, steps(10, 4), Ends::Open);
            }
            for (int i = 0; i < 3; ++i) { // guns
                const double x = side * (2.2 + 0.25 * i);
                const double y = -0.42 + 0.45 * (std::abs(x) - 0.25) / 5.2; // y of the wing's plane at x
                addRod(parts_, {x, y, 0.9}, {x, y, 1.45}, 0.03, steps(8, 3), Ends::Closed);
            }
            addBox(parts_, {side * 2.9 - 0.04, -0.27, -0.95}, {side * 2.9 + 0.04, -0.17, -0.45}); // flap hinge
        }
        addRod(parts_, {0, 0.9, -1.0}, {0, 1.5, -1.1}, 0.012, steps(6, 3), Ends::Closed); // mast of the aerial
        addRod(parts_, {0, 1.5, -1.1}, {0, 1.6, -4.4}, 0.004, 3, Ends::Open);             // wire of the aerial
    }

    void addPropeller(double turns) {
        addSkin(parts_, steps(14, 4), steps(24, 6), [](double u, double v) {
            const double r = 0.31 * std::sqrt(std::max(0.002, 1 - u * u));
            return dvec3(r * cosTurns(v), r * sinTurns(v), 3.82 + 0.75 * u);
        });
        for (int blade = 0; blade < 4; ++blade) {
            const double at = turns + 0.25 * blade;
            const dvec3 out(cosTurns(at), sinTurns(at), 0);
            const dvec3 across(-out.y, out.x, 0);
            addSkin(parts_, steps(18, 4), steps(14, 6), [&](double u, double v) {
                const double pitch = 0.17 - 0.11 * u; // pitch in turns; steep at the hub
                const dvec3 chord = across * cosTurns(pitch) + dvec3(0, 0, sinTurns(pitch));
                const dvec3 thick = dvec3(0, 0, cosTurns(pitch)) - across * sinTurns(pitch);
                const double width = (0.10 + 0.12 * u) * std::sqrt(std::max(0.03, 1 - u * u * u * u));
                return dvec3(0, 0, 4.05) + out * (0.2 + 1.45 * u) + chord * (width * cosTurns(v)) +
                       thick * (0.18 * width * sinTurns(v));
            });
        }
    }

    PartSink& parts_;
    double fineness_;
};

constexpr double kPlaneShare = 0.98;
constexpr double kGroundHalf = 250;

/// Returns the axes of a flying aeroplane as a rotation matrix. The three angles rotate level flight in course, pitch
/// and bank. All angles are in turns.
glm::dmat3 flightAxes(double courseTurns, double pitchTurns, double bankTurns) {
    const dvec3 nose = glm::normalize(dvec3(sinTurns(courseTurns), sinTurns(pitchTurns), cosTurns(courseTurns)));
    const dvec3 level = glm::normalize(glm::cross(dvec3(0, 1, 0), nose));
    const dvec3 top = glm::cross(nose, level);
    const dvec3 right = level * cosTurns(bankTurns) + top * sinTurns(bankTurns);
    return {right, glm::cross(nose, right), nose};
}

} // namespace

Planes::Planes(std::uint64_t triangles, std::uint64_t seed)
    : groundSeed_(static_cast<std::uint32_t>(mix64(seed ^ 0x6E0U))) {
    GNOMON_CHECK_OP(triangles, >=, kMinTriangles);
    Random random(mix64(seed ^ 0x91A7E5U));
    for (std::size_t i = 0; i < kCount; ++i) {
        const auto column = static_cast<double>(i % 5) - 2;
        const std::size_t row = i / 5;
        // Braces guarantee that the random numbers are drawn from left to right. Parentheses do not.
        const dvec3 origin{
            17 * column + random.uniform(-2, 2),
            random.uniform(4, 14),
            22 * static_cast<double>(row) - 3 * std::abs(column) + random.uniform(-3, 3)};
        const double course = random.uniform(-0.02, 0.02);
        const double pitch = random.uniform(-0.01, 0.02);
        const glm::dmat3 axes = flightAxes(course, pitch, random.uniform(-0.05, 0.05));
        places_.push_back({origin, axes, random.unit()});
    }
    const auto planeTriangles = [](double fineness) {
        PartSink counter;
        PlaneBuilder(counter, fineness).addPlane(0);
        return counter.size();
    };
    const auto aim = static_cast<std::uint64_t>(kPlaneShare * static_cast<double>(triangles)) / kCount;
    double low = 1e-3;
    double high = 1e4;
    for (int i = 0; i < 40; ++i) {
        const double middle = std::sqrt(low * high);
        (planeTriangles(middle).triangles <= aim ? low : high) = middle;
    }
    fineness_ = low;
    planeSize_ = planeTriangles(low);
    const auto rest = static_cast<double>(triangles - kCount * planeSize_.triangles);
    groundColumns_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::sqrt(rest / 2)));
    groundRows_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rest / 2) / groundColumns_);
}

MeshSize Planes::blockSize(std::size_t block) const {
    if (block < kCount) return planeSize_;
    return {(groundColumns_ + 1) * (groundRows_ + 1), 2 * groundColumns_ * groundRows_};
}

void Planes::makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const {
    PartSink parts(sink, firstVertex);
    if (block < kCount) {
        const Place& place = places_[block];
        parts.place(place.origin, place.axes);
        PlaneBuilder(parts, fineness_).addPlane(place.propellerTurns);
    } else {
        const MeshSize size = blockSize(block);
        parts.begin(size.vertices, size.triangles);
        for (std::uint64_t row = 0; row <= groundRows_; ++row)
            for (std::uint64_t column = 0; column <= groundColumns_; ++column) {
                const double x = 2 * kGroundHalf * static_cast<double>(column) / static_cast<double>(groundColumns_);
                const double z = 2 * kGroundHalf * static_cast<double>(row) / static_cast<double>(groundRows_);
                const auto height = static_cast<double>(
                    gradientNoise(static_cast<float>(x / 70), static_cast<float>(z / 70), 0.5F, groundSeed_));
                parts.vertex({x - kGroundHalf, 2.5 * height, z - kGroundHalf});
            }
        for (std::uint64_t row = 0; row < groundRows_; ++row)
            for (std::uint64_t column = 0; column < groundColumns_; ++column) {
                const std::uint64_t a = row * (groundColumns_ + 1) + column;
                const std::uint64_t below = a + groundColumns_ + 1;
                parts.quad(a, below, below + 1, a + 1);
            }
    }
    parts.finish();
}

} // namespace gnomon::make
