#include "preprocess/make/plant.h"

#include "core/check.h"
#include "preprocess/make/noise.h"
#include "preprocess/make/plant_units.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gnomon::make {

using glm::dvec3;

namespace {

/// The units on the lots of the plant, one letter per lot, from north to south and from west to east. K: tanks, P:
/// pipes on sleepers, R: pipe rack, T: turbine hall, B: boiler house, C: chimney, X: transformers, H: heat exchangers,
/// A: cooling tower, G: gas turbine, Y: store.
constexpr std::array<std::string_view, 8> kMap{
    "KKPRYGGX", "KKPRTTTX", "KKPRTTTX", "HHPRBBCX", "HHPRBBCY", "HHPRGGYY", "AAARHHKK", "AAARYYKK"};
constexpr std::size_t kLots = 64;
constexpr double kYardHalf = 200;

/// A bed of gravel, given by its centre and half its extents. Beds are below transformers and along the inside of the
/// fence.
struct Bed {
    dvec3 center{0};
    double halfX = 0;
    double halfZ = 0;
};

std::vector<Bed> gravelBeds() {
    std::vector<Bed> beds;
    for (std::size_t row = 0; row < kMap.size(); ++row)
        for (std::size_t column = 0; column < kMap.size(); ++column)
            if (kMap.at(row).at(column) == 'X')
                beds.push_back(
                    {dvec3(
                         kLotPitch * (static_cast<double>(column) - 3.5),
                         0.02,
                         kLotPitch * (static_cast<double>(row) - 3.5)),
                     14,
                     14});
    for (const double side : {-180.0, 180.0}) {
        beds.push_back({dvec3(0, 0.02, side), 178, 10});
        beds.push_back({dvec3(side, 0.02, 0), 10, 168});
    }
    return beds;
}

template <void (*Unit)(Site&)>
void whole(Site& site, std::uint64_t /*piece*/) {
    Unit(site);
}

void addGround(Site& site, std::uint64_t /*piece*/) {
    // The number of cells is random, so that the border vertices of neighbouring tiles do not match.
    Panel tile;
    tile.corner = {-0.5 * kLotPitch, 0, 0.5 * kLotPitch};
    tile.u = {kLotPitch, 0, 0};
    tile.v = {0, 0, -kLotPitch};
    tile.cellsU = 2 + site.random.below(site.detail.amount(5, 3, 200));
    tile.cellsV = 2 + site.random.below(site.detail.amount(5, 3, 200));
    addPanel(site.parts, tile);
    for (const double side : {-1.0, 1.0}) { // kerbs along the edge of the lot
        const double at = side * (0.5 * kLotPitch - 3.5);
        addUnweldedBox(site.parts, {-16, 0, at - 0.1}, {16, 0.12, at + 0.1});
        addBox(site.parts, {at - 0.1, 0, -16}, {at + 0.1, 0.12, 16});
    }
    if (site.random.below(2) == 0) addLamp(site, {-17, 0, -17});
}

void addYardEdge(Site& site, std::uint64_t /*piece*/) {
    Panel strip;
    strip.corner = {-kYardHalf, 0, kYardHalf};
    strip.u = {2 * kYardHalf, 0, 0};
    strip.v = {0, 0, -(kYardHalf - 4 * kLotPitch)};
    strip.cellsU = site.detail.amount(37, 3, 3000);
    strip.cellsV = site.detail.amount(3, 1, 200);
    addPanel(site.parts, strip);
    addFence(site, {-kYardHalf + 5, 0, kYardHalf - 5}, {kYardHalf - 5, 0, kYardHalf - 5});
}

constexpr std::uint64_t kStoneTriangles = 24;
constexpr std::uint64_t kStoneVertices = 17;
constexpr std::uint64_t kStonesPerJob = 8192;
constexpr std::uint64_t kStonesPerCopy = 40; // one of this number of stones is a copy of the stone before

/// Adds a stone of the gravel. It is a dome of two rings and a tip on the ground, without a bottom.
void addStone(PartSink& parts, const Bed& bed, double radius, std::uint64_t seed) {
    if (!parts.begin(kStoneVertices, kStoneTriangles)) return;
    Random random(mix64(seed));
    // Braces guarantee that the random numbers are drawn from left to right. Parentheses do not.
    const dvec3 place{bed.halfX * random.uniform(-1, 1), 0, bed.halfZ * random.uniform(-1, 1)};
    const dvec3 center = bed.center + place;
    const double size = radius * random.uniform(0.5, 1.2);
    const double turn = random.unit();
    for (const double lift : {0.0, 0.55})
        for (int i = 0; i < 8; ++i) {
            const double t = turn + 0.125 * i + 0.3 * lift;
            const double r = size * random.uniform(0.75, 1.15);
            parts.vertex(center + dvec3(r * cosTurns(t), size * lift * random.uniform(0.8, 1.2), -r * sinTurns(t)));
        }
    parts.vertex(center + dvec3(0.1 * size, size * random.uniform(0.8, 1.0), 0));
    for (std::uint64_t i = 0; i < 8; ++i) {
        const std::uint64_t j = (i + 1) % 8;
        parts.quad(i, j, 8 + j, 8 + i);
        parts.triangle(8 + i, 8 + j, 16);
    }
}

void addStones(PartSink& parts, std::uint64_t count, double radius, std::uint64_t seed) {
    const std::vector<Bed> beds = gravelBeds();
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t original = i % kStonesPerCopy == kStonesPerCopy - 1 ? i - 1 : i;
        addStone(parts, beds[original % beds.size()], radius, mix64(seed) + original);
    }
}

/// The share of all triangles that belong to parts other than gravel. Gravel uses the rest.
constexpr double kPartShare = 0.94;
constexpr double kHighestLevel = 4096;
constexpr double kLowestLevel = 1.0 / 64;

} // namespace

Plant::Plant(std::uint64_t triangles, std::uint64_t seed) {
    GNOMON_CHECK_OP(triangles, >=, kMinTriangles);
    const auto aim = static_cast<std::uint64_t>(kPartShare * static_cast<double>(triangles));
    // The code first finds the max number of lots whose triangles fit at the lowest level of detail. Then it finds the
    // highest level of detail that fits for these lots.
    std::size_t lots = kLots;
    for (layOut(seed, lots); lots > 0 && countParts(kLowestLevel) > aim; layOut(seed, lots))
        lots = lots > 8 ? lots - 8 : lots - 1;
    double low = kLowestLevel;
    double high = kHighestLevel;
    for (int i = 0; i < 18 && high / low > 1.001; ++i) {
        const double middle = std::sqrt(low * high);
        (countParts(middle) <= aim ? low : high) = middle;
    }
    level_ = low;
    const std::uint64_t parts = countParts(low);
    addGravel(triangles - parts, seed);
}

void Plant::addLot(char kind, const dvec3& center, std::uint64_t seed) {
    struct Unit {
        char kind;
        MakeParts make;
        bool turns;
    };

    constexpr std::array<Unit, 10> kUnits{{
        {'K', whole<addTankFarm>, true},
        {'P', whole<addPipeSleepers>, false},
        {'R', whole<addPipeRack>, false},
        {'T', whole<addTurbineHall>, false},
        {'C', whole<addChimney>, false},
        {'X', whole<addTransformers>, true},
        {'H', whole<addExchangers>, true},
        {'A', whole<addCoolingTower>, true},
        {'G', whole<addGasTurbine>, true},
        {'Y', whole<addStore>, true},
    }};
    const int turns = static_cast<int>(mix64(seed) & 3U);
    if (kind == 'B') {
        for (std::uint64_t storey = 0; storey < kBoilerStoreys; ++storey)
            jobs_.push_back({addBoilerStorey, storey, center, 0, mix64(seed + storey), {}});
        return;
    }
    for (const Unit& unit : kUnits)
        if (unit.kind == kind) jobs_.push_back({unit.make, 0, center, unit.turns ? turns : 0, mix64(seed), {}});
}

void Plant::layOut(std::uint64_t seed, std::size_t lotsBuilt) {
    jobs_.clear();
    for (int side = 0; side < 4; ++side)
        jobs_.push_back({addYardEdge, 0, dvec3(0), side, mix64(seed * 4 + static_cast<std::uint64_t>(side)), {}});
    for (std::size_t lot = 0; lot < kLots; ++lot) {
        const std::size_t row = lot / 8;
        const std::size_t column = lot % 8;
        const dvec3 center(
            kLotPitch * (static_cast<double>(column) - 3.5), 0, kLotPitch * (static_cast<double>(row) - 3.5));
        const std::uint64_t lotSeed = mix64(seed * kLots + lot);
        jobs_.push_back({addGround, 0, center, static_cast<int>(lotSeed & 3U), lotSeed, {}});
        // The used lots of a small plant are spread over the whole yard, because 27 and 64 have no common factor.
        if (lot * 27 % kLots < lotsBuilt) addLot(kMap.at(row).at(column), center, lotSeed);
    }
}

void Plant::makeJob(const Job& job, PartSink& parts, const Detail& detail) const {
    parts.place(job.origin, quarterTurned(job.quarterTurns));
    if (job.make == nullptr) {
        addStones(parts, job.piece, stoneRadius_, job.seed);
        return;
    }
    Site site{parts, detail, Random(job.seed)};
    job.make(site, job.piece);
}

std::uint64_t Plant::countParts(double level) {
    const Detail detail(level);
    tbb::parallel_for(std::size_t{0}, jobs_.size(), [&](std::size_t i) {
        PartSink counter;
        makeJob(jobs_[i], counter, detail);
        jobs_[i].size = counter.size();
    });
    std::uint64_t sum = 0;
    for (const Job& job : jobs_)
        sum += job.size.triangles;
    return sum;
}

void Plant::addGravel(std::uint64_t triangles, std::uint64_t seed) {
    const std::uint64_t stones = triangles / kStoneTriangles;
    double area = 0;
    for (const Bed& bed : gravelBeds())
        area += 4 * bed.halfX * bed.halfZ;
    stoneRadius_ =
        std::clamp(0.3 * std::sqrt(area / static_cast<double>(std::max<std::uint64_t>(1, stones))), 0.004, 0.07);
    for (std::uint64_t first = 0; first < stones; first += kStonesPerJob) {
        const std::uint64_t count = std::min(kStonesPerJob, stones - first);
        jobs_.push_back(
            {nullptr,
             count,
             dvec3(0),
             0,
             mix64(seed ^ 0x57011E5U) + first,
             MeshSize{count * kStoneVertices, count * kStoneTriangles}});
    }
}

void Plant::makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const {
    PartSink parts(sink, firstVertex);
    makeJob(jobs_[block], parts, Detail(level_));
    parts.finish();
}

} // namespace gnomon::make
