// A sound model passes every check; each planted fault is found by the check that is there for it.
#include "core/error.h"
#include "core/file.h"
#include "hierarchy/cut_rule.h"
#include "hierarchy/model_file.h"
#include "preprocess/exporter/export.h"
#include "preprocess/verify/verify.h"
#include "tests/support/sanitizers.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

namespace gnomon::verify {
namespace {

using namespace hierarchy;
using tests::TinyModel;

std::string pathFor(const std::string& name) {
    const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
    return testing::TempDir() + "gnomon_verify_" + test + "_" + name;
}

TinyModel soundModel() {
    tests::TinyModelOptions options;
    options.gridExponent = 5;
    options.clusterTriangles = 64;
    options.pageGroups = 3;
    return tests::makeTinyModel(options);
}

/// The source of a tiny model: its finest cut.
std::string sourceOf(const TinyModel& model) {
    tests::writeModel(model, pathFor("sound.gnm"));
    NoProgress progress;
    exporter::exportCut(pathFor("sound.gnm"), {{}, model.summary.grid.snapError()}, pathFor("source.ply"), progress);
    return pathFor("source.ply");
}

Verification verified(const TinyModel& model, const std::string& source = {}) {
    tests::writeModel(model, pathFor("m.gnm"));
    NoProgress progress;
    VerifyOptions options{pathFor("m.gnm"), {}, 60, 1};
    if (!source.empty()) options.source = {source};
    return verifyModel(options, progress);
}

/// Stops at the first block of the stage of that name, as Ctrl-C does.
class StopInStage final : public Progress {
public:
    explicit StopInStage(std::string name) : name_(std::move(name)) {}

    void stage(std::string_view name, std::string_view /*unit*/, std::uint64_t /*total*/) override {
        isThere_ = name == name_;
    }

    void advance(std::uint64_t /*count*/) override {
        if (isThere_) throw Interrupted{};
    }

private:
    std::string name_;
    bool isThere_ = false;
};

const Check& named(const Verification& verification, const std::string& name) {
    for (const Check& check : verification.checks)
        if (check.name == name) return check;
    throw Error("no check " + name);
}

/// Names of the checks that failed, in order.
std::string failures(const Verification& verification) {
    std::string names;
    for (const Check& check : verification.checks)
        if (check.failed > 0) names += check.name + " ";
    return names;
}

/// The first page of a level, counted from the finest.
Page& pageOfLevel(TinyModel& model, std::uint32_t level) {
    for (Page& page : model.pages)
        if (page.level == level) return page;
    throw Error("no level " + std::to_string(level));
}

/// All copies of what a refinement tells of a group.
template <class Change>
void changeGroup(TinyModel& model, std::uint32_t page, std::uint32_t index, const Change& change) {
    Group& group = model.pages[page].groups[index];
    change(group.bounds, group.error);
    for (Page& other : model.pages)
        for (Refinement& refinement : other.refinements)
            if (refinement.group == GroupRef{page, index}) change(refinement.bounds, refinement.error);
}

/// Makes boxes and the summary's errors fit what was changed.
void mend(TinyModel& model) {
    for (Page& page : model.pages) {
        for (Cluster& cluster : page.clusters) {
            cluster.box = {};
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
                cluster.box.add(page.vertices[cluster.firstVertex + v].position);
        }
        for (Group& group : page.groups) {
            group.box = {};
            for (std::uint32_t c = 0; c < group.clusterCount; ++c)
                group.box.add(page.clusters[group.firstCluster + c].box);
        }
    }
    for (LevelInfo& level : model.summary.levels)
        level.maxError = 0;
    for (const Page& page : model.pages)
        for (const Cluster& cluster : page.clusters) {
            double& error = model.summary.levels[page.level].maxError;
            error = std::max(error, storedError(page, cluster, model.summary.grid.snapError()));
        }
}

TEST(Verify, CanBeStoppedWhileItReadsTheSource) {
    const TinyModel model = soundModel();
    const std::string source = sourceOf(model);
    tests::writeModel(model, pathFor("m.gnm"));
    StopInStage stop("read the source");
    EXPECT_THROW(verifyModel({pathFor("m.gnm"), {source}, 1, 1}, stop), Interrupted);
}

TEST(Verify, ASoundModelPasses) {
    const TinyModel model = soundModel();
    const Verification verification = verified(model, sourceOf(model));
    EXPECT_EQ(failures(verification), "");
    EXPECT_TRUE(verification.ok());
    ASSERT_EQ(verification.checks.size(), 6U);
    for (const Check& check : verification.checks)
        EXPECT_GT(check.tested, 0U) << check.name;
    const Check& bound = named(verification, "error_bound");
    EXPECT_LE(bound.worst, 1);
    ASSERT_TRUE(bound.tightness.has_value());
    EXPECT_GE(*bound.tightness, 1);
    EXPECT_LE(*bound.tightness, 4);
    ASSERT_GT(bound.cuts.size(), 1U);
    for (std::size_t i = 0; i < bound.cuts.size(); ++i) {
        const SampledCut& cut = bound.cuts[i];
        EXPECT_LE(cut.sampledRms, cut.sampledLargest);
        EXPECT_LE(cut.sampledLargest, cut.stored + model.summary.grid.snapError());
        if (i == 0) continue;
        EXPECT_LT(cut.triangles, bound.cuts[i - 1].triangles);
        EXPECT_GT(cut.sampledRms, bound.cuts[i - 1].sampledRms);
    }
    EXPECT_GT(named(verification, "cracks").tested, 10'000U);
}

TEST(Verify, IsTheSameForTheSameSeed) {
    const TinyModel model = soundModel();
    const std::string source = sourceOf(model);
    const Verification a = verified(model, source);
    const Verification b = verified(model, source);
    for (std::size_t i = 0; i < a.checks.size(); ++i) {
        EXPECT_EQ(a.checks[i].tested, b.checks[i].tested);
        EXPECT_EQ(a.checks[i].worst, b.checks[i].worst);
    }
    EXPECT_EQ(named(a, "error_bound").tightness, named(b, "error_bound").tightness);
}

TEST(Verify, AFlippedByteFailsChecksums) {
    const TinyModel model = soundModel();
    tests::writeModel(model, pathFor("m.gnm"));
    const std::string good = readTextFile(pathFor("m.gnm"));
    const ModelFile file(pathFor("m.gnm"));
    for (const std::uint64_t offset :
         {file.pages()[1].offset + 9, std::uint64_t{good.size() - 100}, std::uint64_t{20}}) {
        std::string bad = good;
        bad[offset] = static_cast<char>(bad[offset] ^ 4);
        writeTextFile(pathFor("bad.gnm"), bad);
        NoProgress progress;
        const Verification verification = verifyModel({pathFor("bad.gnm"), {}, 3, 1}, progress);
        EXPECT_EQ(failures(verification), "checksums ") << "byte " << offset;
        EXPECT_NE(verification.checks[0].detail.find("byte "), std::string::npos);
    }
    NoProgress progress;
    EXPECT_THROW(verifyModel({pathFor("not_there.gnm"), {}, 3, 1}, progress), Error);
}

TEST(Verify, ARefinementOfNothingFailsStructure) {
    TinyModel model = soundModel();
    pageOfLevel(model, 1).refinements[0].group.group += 100;
    const Verification verification = verified(model);
    EXPECT_EQ(failures(verification), "structure ");
    EXPECT_EQ(named(verification, "cracks").tested, 0U);
}

TEST(Verify, ACopyThatDisagreesFailsStructure) {
    TinyModel model = soundModel();
    pageOfLevel(model, 1).refinements[0].error *= 0.99;
    mend(model);
    EXPECT_EQ(failures(verified(model)), "structure ");
}

TEST(Verify, AGroupThatNothingRefinesToFailsStructure) {
    TinyModel model = soundModel();
    Page& page = pageOfLevel(model, 1);
    const GroupRef lost = page.refinements[0].group;
    for (Page& other : model.pages)
        for (Refinement& refinement : other.refinements)
            if (refinement.group == lost) refinement = other.refinements[&refinement == &other.refinements[0] ? 1 : 0];
    EXPECT_NE(failures(verified(model)).find("structure"), std::string::npos);
}

TEST(Verify, LostTrianglesFailStructure) {
    TinyModel model = soundModel();
    model.summary.sourceTriangles += 1;
    EXPECT_EQ(failures(verified(model)), "structure ");
    model.summary.dropped["doubled"] = 1;
    EXPECT_EQ(failures(verified(model)), "");
}

TEST(Verify, AShrunkenSphereFailsNesting) {
    TinyModel model = soundModel();
    const GroupRef ref = pageOfLevel(model, 2).refinements[0].group;
    changeGroup(model, ref.page, ref.group, [](Sphere& bounds, double&) { bounds.radius *= 0.9; });
    const Verification verification = verified(model);
    EXPECT_NE(failures(verification).find("nesting"), std::string::npos);
    EXPECT_GT(named(verification, "nesting").worst, 0);
    EXPECT_EQ(failures(verification).find("monotone"), std::string::npos);
}

TEST(Verify, ALoweredErrorFailsMonotoneError) {
    TinyModel model = soundModel();
    const GroupRef ref = pageOfLevel(model, 2).refinements[0].group;
    const Page& page = model.pages[ref.page];
    double finer = 0;
    for (std::uint32_t c = 0; c < page.groups[ref.group].clusterCount; ++c)
        finer = std::max(finer, storedError(page, page.clusters[page.groups[ref.group].firstCluster + c], 0));
    changeGroup(model, ref.page, ref.group, [finer](Sphere&, double& error) { error = finer * 0.9; });
    mend(model);
    const Verification verification = verified(model);
    EXPECT_NE(failures(verification).find("monotone_error"), std::string::npos);
    EXPECT_GT(named(verification, "monotone_error").worst, 0);
}

TEST(Verify, AClaimOfTooLittleErrorFailsErrorBound) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    TinyModel model = soundModel();
    const std::string source = sourceOf(model);
    const double estimated = model.summary.grid.snapError() * 1.5;
    for (std::uint32_t p = 0; p < model.pages.size(); ++p)
        for (std::uint32_t g = 0; g < model.pages[p].groups.size(); ++g)
            if (model.pages[p].level == 0)
                changeGroup(model, p, g, [estimated](Sphere&, double& error) { error = estimated; });
    mend(model);
    const Verification verification = verified(model, source);
    EXPECT_EQ(failures(verification), "error_bound ");
    EXPECT_GT(named(verification, "error_bound").worst, 1);
}

TEST(Verify, ALostPartOfTheSourceFailsErrorBound) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    TinyModel model = soundModel();
    const std::string source = sourceOf(model);
    // A pit in one coarse cluster: the source sees it from the other side too.
    Page& page = pageOfLevel(model, 1);
    for (std::uint32_t v = 0; v < page.clusters[0].vertexCount; ++v)
        page.vertices[page.clusters[0].firstVertex + v].position.y += 2000;
    mend(model);
    EXPECT_NE(failures(verified(model, source)).find("error_bound"), std::string::npos);
}

TEST(Verify, AMovedBorderVertexFailsCracks) {
    TinyModel model = soundModel();
    // Some vertex of a coarse cluster lies on the border of its group: move them one after the other until one does.
    Page& page = pageOfLevel(model, 1);
    std::uint32_t found = 0;
    const std::uint32_t vertices = page.clusters[0].vertexCount;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        std::uint32_t& y = page.vertices[page.clusters[0].firstVertex + v].position.y;
        y += 1;
        mend(model);
        const Verification verification = verified(model);
        if (named(verification, "cracks").failed > 0) ++found;
        EXPECT_EQ(named(verification, "cracks").failed > 0, failures(verification) == "cracks ");
        y -= 1;
    }
    EXPECT_GT(found, vertices / 10);
    EXPECT_LT(found, vertices) << "vertices inside a group are nobody's border";
}

TEST(Verify, SpheresThatDoNotNestLetCutsCrack) {
    TinyModel model = soundModel();
    // The decision for one group of the middle is made as if it lay far away: it is refined later than its parents.
    const GroupRef ref = pageOfLevel(model, 2).refinements[0].group;
    changeGroup(model, ref.page, ref.group, [](Sphere& bounds, double& error) {
        bounds.radius = 0;
        bounds.center += glm::dvec3(1e4);
        error *= 1e-3;
    });
    mend(model);
    const std::string found = failures(verified(model));
    EXPECT_NE(found.find("cracks"), std::string::npos) << found;
}

} // namespace
} // namespace gnomon::verify
