// The parts of verify by themselves: cuts and bounds against chains, each rule's own words.
#include "core/random.h"
#include "preprocess/read/memory_source.h"
#include "preprocess/verify/check.h"
#include "preprocess/verify/crack_cells.h"
#include "preprocess/verify/cracks.h"
#include "preprocess/verify/error_bound.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/model_facts.h"
#include "preprocess/verify/rules.h"
#include "preprocess/verify/source_soup.h"
#include "preprocess/verify/uniform_cut.h"
#include "tests/support/sanitizers.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace gnomon::verify {
namespace {

using namespace hierarchy;

LoadedModel loadedOf(const tests::TinyModel& tiny) {
    LoadedModel model;
    model.summary = tiny.summary;
    model.pages = tiny.pages;
    model.firstGroup = {0};
    model.firstCluster = {0};
    for (const Page& page : model.pages) {
        model.firstGroup.push_back(model.firstGroup.back() + static_cast<std::uint32_t>(page.groups.size()));
        model.firstCluster.push_back(model.firstCluster.back() + static_cast<std::uint32_t>(page.clusters.size()));
        model.levels.push_back(page.level);
    }
    return model;
}

LoadedModel smallModel() {
    tests::TinyModelOptions options;
    options.gridExponent = 4;
    options.clusterTriangles = 32;
    options.groupClusters = 3;
    options.pageGroups = 2;
    return loadedOf(tests::makeTinyModel(options));
}

ModelFacts factsOf(const LoadedModel& model) {
    ModelFacts facts{model.summary, {}, {}};
    for (std::size_t page = 0; page < model.pages.size(); ++page)
        facts.pages.push_back(verify::factsOf(model.pages[page], page, model.summary.grid));
    return facts;
}

TEST(UniformCut, IsWhatTheRuleDrawsAtOneError) {
    const LoadedModel model = smallModel();
    std::set<double> limits{0, 1e30};
    for (const LevelInfo& level : model.summary.levels)
        limits.insert(level.maxError);
    std::size_t last = 0;
    for (const double limit : std::vector<double>(limits.rbegin(), limits.rend())) {
        const UniformCut cut = uniformCut(model, limit);
        EXPECT_GE(cut.soup.triangles.size(), last) << "a smaller error takes no fewer triangles";
        last = cut.soup.triangles.size();
        for (std::size_t i = 0; i < cut.parts.size(); ++i) {
            const UniformCut::Part& part = cut.parts[i];
            const Page& page = model.pages[part.page];
            const Cluster& cluster = page.clusters[part.cluster];
            const double finer = cluster.refinement == kNone ? 0 : page.refinements[cluster.refinement].error;
            EXPECT_LE(finer, limit);
            const std::size_t end =
                i + 1 < cut.parts.size() ? cut.parts[i + 1].firstTriangle : cut.soup.triangles.size();
            EXPECT_EQ(end - part.firstTriangle, cluster.triangleCount);
            for (const std::uint32_t t : {part.firstTriangle, static_cast<std::uint32_t>(end - 1)})
                EXPECT_EQ(&cut.partOf(t), &part);
        }
    }
    EXPECT_EQ(last, model.summary.sourceTriangles) << "at an error of 0 all of level 0";
    EXPECT_EQ(uniformCut(model, 1e30).soup.triangles.size(), model.summary.coarsestTriangles);
}

TEST(BoundsInCut, AreTheLargestErrorOfWhatStandsForAGroup) {
    const LoadedModel model = smallModel();
    // Upwards from each group: who refines into it, and so stands for it.
    std::map<std::uint32_t, std::set<std::uint32_t>> coarser;
    std::vector<double> errorOf;
    for (std::size_t p = 0; p < model.pages.size(); ++p)
        for (std::uint32_t g = 0; g < model.pages[p].groups.size(); ++g) {
            const Group& group = model.pages[p].groups[g];
            errorOf.push_back(group.error);
            for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
                const std::uint32_t refinement = model.pages[p].clusters[group.firstCluster + c].refinement;
                if (refinement != kNone)
                    coarser[model.groupNumber(model.pages[p].refinements[refinement].group)].insert(
                        model.firstGroup[p] + g);
            }
        }
    for (const double limit : {0.0, model.summary.levels[1].maxError, model.summary.levels[2].maxError, 1e30}) {
        const std::vector<double> bounds = boundsInCut(model, limit);
        ASSERT_EQ(bounds.size(), errorOf.size());
        const std::function<double(std::uint32_t)> slow = [&](std::uint32_t group) {
            if (errorOf[group] > limit) return 0.0;
            double max = errorOf[group];
            for (const std::uint32_t above : coarser[group])
                max = std::max(max, slow(above));
            return max;
        };
        for (std::uint32_t group = 0; group < bounds.size(); ++group)
            EXPECT_EQ(bounds[group], slow(group)) << group << " at " << limit;
    }
}

TEST(Rules, ASoundModelKeepsThemAll) {
    const LoadedModel model = smallModel();
    const ModelFacts facts = factsOf(model);
    EXPECT_TRUE(refinementsResolve(facts));
    for (const Check& check : {checkStructure(facts), checkNesting(facts), checkMonotoneError(facts)}) {
        EXPECT_GT(check.tested, 10U) << check.name;
        EXPECT_EQ(check.failed, 0U) << check.name << ": " << check.detail;
        EXPECT_LE(check.worst, 1e-9) << check.name;
    }
    NoProgress progress;
    const Check cracks = checkCracks(model, 20, 3, progress);
    EXPECT_GT(cracks.tested, 1000U);
    EXPECT_EQ(cracks.failed, 0U) << cracks.detail;
    EXPECT_NE(cracks.detail.find("20 cuts, "), std::string::npos);
}

/// The first page that has refinements.
Page& refiningPage(std::vector<Page>& pages) {
    for (Page& page : pages)
        if (!page.refinements.empty()) return page;
    throw std::logic_error("no page refines");
}

tests::TinyModel modelOfManyPages() {
    tests::TinyModelOptions options;
    options.gridExponent = 6;
    options.clusterTriangles = 32;
    options.pageGroups = 1;
    return tests::makeTinyModel(options);
}

TEST(CrackCells, FillTheGridAndHaveAllPagesThatMeetThem) {
    const tests::TinyModel tiny = modelOfManyPages();
    const std::string path = testing::TempDir() + "gnomon_crack_cells.gnm";
    tests::writeModel(tiny, path);
    const ModelFile file(path);
    std::size_t max = 0;
    for (const std::uint64_t memory : {1ULL << 40U, 1ULL << 21U, 1ULL << 19U, 1ULL << 17U, 1ULL}) {
        const std::vector<CrackCell> cells = crackCells(file.pages(), {memory});
        EXPECT_GE(cells.size(), max);
        max = cells.size();
        double volume = 0;
        for (const CrackCell& cell : cells) {
            const auto length = [](std::uint32_t low, std::uint32_t high) { return std::ldexp(high - low + 1U, -31); };
            volume += length(cell.box.min.x, cell.box.max.x) * length(cell.box.min.y, cell.box.max.y) *
                      length(cell.box.min.z, cell.box.max.z);
            std::vector<std::uint32_t> met;
            for (std::uint32_t p = 0; p < file.pages().size(); ++p) {
                const GridBox& box = file.pages()[p].box;
                if (box.min.x <= cell.box.max.x && box.max.x >= cell.box.min.x && box.min.y <= cell.box.max.y &&
                    box.max.y >= cell.box.min.y && box.min.z <= cell.box.max.z && box.max.z >= cell.box.min.z)
                    met.push_back(p);
            }
            EXPECT_EQ(cell.pages, met);
        }
        EXPECT_EQ(volume, 1) << "none twice, none left out";
    }
    EXPECT_GT(max, 4U);
}

// What a whole model in memory has, any number of cells has.
TEST(Cracks, OfAFileCellByCellAreThoseOfTheWhole) {
    tests::TinyModel tiny = modelOfManyPages();
    const std::string path = testing::TempDir() + "gnomon_cracks.gnm";
    NoProgress progress;
    for (const bool isCracked : {false, true}) {
        // A cluster that is drawn where what its neighbours refine to is not.
        if (isCracked) refiningPage(tiny.pages).refinements[0].error *= 0.01;
        tests::writeModel(tiny, path);
        const ModelFile file(path);
        const ModelFacts facts = readFacts(file, progress);
        const Check whole = checkCracks(loadModel(file, progress), 40, 5, progress);
        EXPECT_GT(whole.tested, 1000U);
        EXPECT_EQ(whole.failed > 0, isCracked);
        EXPECT_GT(crackCells(file.pages(), {1ULL << 17U}).size(), 4U);
        for (const std::uint64_t memory : {1ULL << 40U, 1ULL << 19U, 1ULL << 17U}) {
            const Check parts = checkCracks(file, facts, 40, 5, crackCells(file.pages(), {memory}), progress);
            EXPECT_EQ(parts.tested, whole.tested);
            EXPECT_EQ(parts.failed, whole.failed);
            EXPECT_EQ(parts.worst, whole.worst);
            EXPECT_EQ(isCracked || parts.detail == whole.detail, true) << parts.detail;
        }
    }
}

TEST(Rules, EachBreachIsToldInItsOwnWords) {
    const auto structure = [](auto&& breakIt) {
        LoadedModel model = smallModel();
        breakIt(model);
        return checkStructure(factsOf(model)).detail;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    has(structure([](LoadedModel& m) { refiningPage(m.pages).refinements[0].group.group = 1000; }),
        "names no finer group");
    has(structure([](LoadedModel& m) { refiningPage(m.pages).refinements[0].error *= 2; }),
        "bounds or an error that are not those of the group that it names");
    has(structure([](LoadedModel& m) { refiningPage(m.pages).refinements[0].attributeError = 1; }),
        "bounds or an error that are not those of the group that it names");
    has(structure([](LoadedModel& m) { m.summary.levels[1].maxAttributeError = 1; }), "summary of level 1 is not the");
    has(structure(
            [](LoadedModel& m) { refiningPage(m.pages).refinements.push_back(refiningPage(m.pages).refinements[0]); }),
        "belongs to no cluster");
    has(structure([](LoadedModel& m) { m.summary.levels[0].triangles += 1; }), "summary of level 0 is not the sum");
    has(structure([](LoadedModel& m) { m.summary.levels[1].maxError *= 2; }), "summary of level 1 is not the sum");
    has(structure([](LoadedModel& m) { m.summary.coarsestTriangles += 1; }), "the root groups have ");
    has(structure([](LoadedModel& m) { m.summary.sourceTriangles += 1; }),
        "triangles of level 0 and dropped ones are ");
    has(structure([](LoadedModel& m) { m.summary.levels.pop_back(); }), "a page has level ");
    has(structure([](LoadedModel& m) { m.pages[0].clusters[0].box.min.x += 1; }), "page 0: cluster 0 has a box");
    has(structure([](LoadedModel& m) { m.pages.back().groups[0].error = std::numeric_limits<double>::infinity(); }),
        "");
    LoadedModel dropped = smallModel();
    dropped.summary.sourceTriangles += 3;
    dropped.summary.dropped = {{"degenerate", 1}, {"doubled", 2}, {"not_a_polygon", 100}};
    EXPECT_EQ(checkStructure(factsOf(dropped)).failed, 0U) << "what is no polygon has no triangles";
    LoadedModel unresolved = smallModel();
    refiningPage(unresolved.pages).refinements[0].group.page = 0;
    EXPECT_FALSE(refinementsResolve(factsOf(unresolved))) << "a page of its own level or a coarser one";
}

TEST(Rules, TheWorstIsHowFarItIsBroken) {
    LoadedModel loose = smallModel();
    Page& page = refiningPage(loose.pages);
    Group& group = page.groups[0];
    group.bounds.radius -= 0.5;
    const Check nesting = checkNesting(factsOf(loose));
    EXPECT_GT(nesting.failed, 0U);
    EXPECT_GT(nesting.worst, 0);
    EXPECT_LE(nesting.worst, 0.5 + 1e-9);
    LoadedModel low = smallModel();
    double finer = 0;
    Page* other = nullptr;
    for (Page& each : low.pages)
        if (!each.refinements.empty() && std::isfinite(each.groups[0].error)) other = &each;
    ASSERT_NE(other, nullptr);
    for (std::uint32_t c = 0; c < other->groups[0].clusterCount; ++c)
        finer =
            std::max(finer, other->refinements[other->clusters[other->groups[0].firstCluster + c].refinement].error);
    other->groups[0].error = finer - 0.125;
    const Check monotone = checkMonotoneError(factsOf(low));
    EXPECT_GT(monotone.failed, 0U);
    EXPECT_NEAR(monotone.worst, 0.125, 1e-12);
    EXPECT_NE(monotone.detail.find("has an error below that of one of its clusters"), std::string::npos);
}

TEST(Rules, ErrorsOfAttributesNeverDecreaseEither) {
    LoadedModel model = smallModel();
    for (Page& page : model.pages)
        for (Refinement& refinement : page.refinements)
            refinement.attributeError = 0.5;
    std::uint64_t below = 0;
    for (Page& page : model.pages)
        for (Group& group : page.groups) {
            group.attributeError = std::isinf(group.error) ? 0 : 0.25;
            if (page.level > 0 && !std::isinf(group.error)) below += group.clusterCount;
        }
    ASSERT_GT(below, 0U);
    const Check low = checkMonotoneError(factsOf(model));
    EXPECT_EQ(low.failed, below);
    EXPECT_NE(low.detail.find("has an error of attributes below that of one of its clusters"), std::string::npos);
    for (Page& page : model.pages)
        for (Group& group : page.groups)
            group.attributeError *= 2;
    EXPECT_EQ(checkMonotoneError(factsOf(model)).failed, 0U);
}

TEST(Check, CallsForWordsOnceAndCountsAll) {
    Check check{"name"};
    int calls = 0;
    for (int i = 0; i < 5; ++i)
        check.test(i < 2, [&] { return "failed " + std::to_string(++calls); });
    EXPECT_EQ(check.tested, 5U);
    EXPECT_EQ(check.failed, 3U);
    EXPECT_EQ(check.detail, "failed 1");
    EXPECT_EQ(calls, 1);
    Verification verification;
    EXPECT_TRUE(verification.ok());
    verification.checks = {Check{"good"}, check};
    EXPECT_FALSE(verification.ok());
}

TEST(SourceSoup, IsTheSourceLessItsOriginAndWhatTheGridCollapses) {
    read::MemoryMesh mesh;
    mesh.positions = {{100, 0, 0}, {101, 0, 0}, {100, 1, 0}, {100.1, 0, 0}, {102, 2, 0}};
    mesh.faceSizes = {3, 3, 4};
    mesh.corners = {0, 1, 2, 0, 3, 1, 0, 1, 4, 2};
    const auto source = read::memorySource("mesh", 1, mesh);
    NoProgress progress;
    const TriangleSoup soup = readSoup(*source, Grid{{100, 0, 0}, -2}, progress);
    EXPECT_EQ(soup.positions[1], glm::dvec3(1, 0, 0));
    ASSERT_EQ(soup.triangles.size(), 3U) << "the second has two corners at one point of the grid";
    EXPECT_EQ(soup.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    const double square = soup.area(1) + soup.area(2);
    EXPECT_NEAR(square, 2, 1e-12) << "a kite of two triangles";
    EXPECT_EQ(soup.point(0, 0, 0), soup.corner(0, 0));
    EXPECT_EQ(soup.point(0, 1, 0), soup.corner(0, 1));
    EXPECT_EQ(soup.point(0, 0, 1), soup.corner(0, 2));
}

TEST(ErrorBound, OfAModelAgainstItselfIsKeptAndAShiftedSourceIsNot) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const LoadedModel model = smallModel();
    NoProgress progress;
    TriangleSoup source = uniformCut(model, 0).soup;
    const Check sound = checkErrorBound(model, source, 1, progress);
    EXPECT_EQ(sound.failed, 0U) << sound.detail;
    EXPECT_LE(sound.worst, 1 + 1e-9);
    EXPECT_GT(sound.tested, 100000U);
    for (glm::dvec3& position : source.positions)
        position.y += 5;
    const Check shifted = checkErrorBound(model, source, 1, progress);
    EXPECT_GT(shifted.failed, sound.tested / 10);
    EXPECT_GT(shifted.worst, 1);
    EXPECT_NE(shifted.detail.find(" away where the stored error is "), std::string::npos);
}

} // namespace
} // namespace gnomon::verify
