// What of a model is in memory for a frame: what tables take, what is asked for, and where a motion leads.
#include "core/error.h"
#include "frame/residency.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include <unistd.h>

namespace gnomon::frame {
namespace {

class ModelResidency : public testing::Test {
protected:
    void SetUp() override {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.clusterTriangles = 32;
        tests::writeModel(tests::makeTinyModel(options), path);
    }

    void TearDown() override { std::filesystem::remove(path); }

    std::string path = testing::TempDir() + "gnomon_residency_" + std::to_string(::getpid()) + ".gnm";
};

lod::DetailView viewFrom(const glm::dvec3& eye) {
    lod::DetailView view;
    view.eye = eye;
    view.basis = cameraBasis({eye, glm::dvec3(32, 0, 32), {0, 1, 0}, 1});
    return view;
}

/// The query of a cut through what is seen from near the model's corner, asked for at one pixel.
struct SeenCut {
    explicit SeenCut(Residency& residency) : query(residency.query()) {
        query.rule = &rule;
        query.errorPixels = 1;
        query.volumes = volumes;
    }

    SeenCut(const SeenCut&) = delete;
    SeenCut& operator=(const SeenCut&) = delete;
    SeenCut(SeenCut&&) = delete;
    SeenCut& operator=(SeenCut&&) = delete;
    ~SeenCut() = default;

    const lod::DetailView view = viewFrom({10, 15, 10});
    const lod::ErrorRule rule{view};
    const std::vector<ConvexVolume> volumes{lod::viewPyramid(view)};
    lod::CutQuery query;
};

TEST_F(ModelResidency, AFrameThatWaitsHasAllThatItsCutWants) {
    const hierarchy::ModelFile model(path);
    Residency residency(model, {});
    SeenCut seen(residency);
    lod::CutQuery& query = seen.query;
    residency.admitLoaded(Waiting::UntilComplete);
    lod::Cut cut = lod::cut(query);
    int rounds = 0;
    while (residency.serve(query, cut, Waiting::UntilComplete).hasChanged) {
        ASSERT_LT(++rounds, 50);
        query.resident = residency.resident();
        cut = lod::cut(query);
    }
    EXPECT_GT(rounds, 0);
    EXPECT_TRUE(cut.wanted.empty());
    EXPECT_LE(cut.achievedErrorPixels, 1);
    EXPECT_EQ(residency.statistics().pagesDamaged, 0U);
    for (std::uint32_t page = 0; page < model.pages().size(); ++page)
        EXPECT_FALSE(residency.isDamaged(page));
    EXPECT_EQ(residency.query().trees->grid().stepExponent, model.summary().grid.stepExponent);
}

TEST_F(ModelResidency, AFrameThatNeverWaitsArrivesInTheEnd) {
    const hierarchy::ModelFile model(path);
    Residency residency(model, {});
    SeenCut seen(residency);
    lod::CutQuery& query = seen.query;
    for (int frame = 0; frame < 20000; ++frame) {
        residency.admitLoaded(Waiting::Never);
        query.resident = residency.resident();
        const lod::Cut cut = lod::cut(query);
        const lod::DemandOutcome outcome = residency.serve(query, cut, Waiting::Never);
        if (cut.wanted.empty() && outcome.pagesMissing == 0) return;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    ADD_FAILURE() << "pages never arrive";
}

TEST_F(ModelResidency, PagesOutOfViewAreRankedLast) {
    const hierarchy::ModelFile model(path);
    Residency residency(model, {});
    const SeenCut seen(residency);
    std::vector<hierarchy::PageDemand> demands;
    for (std::uint32_t page = 0; page < model.pages().size(); ++page) {
        const hierarchy::PageInfo& info = model.pages()[page];
        demands.push_back({page, std::isinf(info.maxError) ? info.maxError : 1e9}); // as spheres around the eye have it
    }
    const std::vector<hierarchy::PageDemand> ranked = rankedByBoxes(seen.query, demands, model.pages());
    ASSERT_EQ(ranked.size(), demands.size());
    double minSeen = 1e300;
    double maxUnseen = 0;
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        const hierarchy::PageInfo& info = model.pages()[ranked[i].page];
        EXPECT_EQ(ranked[i].page, demands[i].page);
        EXPECT_GT(ranked[i].pixels, 0);
        EXPECT_LE(ranked[i].pixels, demands[i].pixels);
        if (std::isinf(info.maxError)) {
            EXPECT_EQ(ranked[i].pixels, info.maxError);
            continue;
        }
        Box box = model.summary().grid.local(info.box);
        box.min -= info.maxError;
        box.max += info.maxError;
        const bool isSeen = classify(seen.volumes[0], box) != Containment::Outside;
        if (isSeen) minSeen = std::min(minSeen, ranked[i].pixels);
        if (!isSeen) maxUnseen = std::max(maxUnseen, ranked[i].pixels);
    }
    EXPECT_GT(maxUnseen, 0);
    EXPECT_LT(maxUnseen, minSeen);
}

TEST_F(ModelResidency, WhatShadowsNeedIsRankedByThem) {
    const hierarchy::ModelFile model(path);
    Residency residency(model, {});
    const SeenCut seen(residency);
    lod::CasterDetail caster; // anything anywhere, with shadows at one unit from the eye
    caster.receiverNear = 1;
    const lod::ErrorRule rule(seen.view, {caster});
    lod::CutQuery query = seen.query;
    query.rule = &rule;
    for (std::uint32_t page = 0; page < model.pages().size(); ++page) {
        const hierarchy::PageInfo& info = model.pages()[page];
        if (std::isinf(info.maxError)) continue;
        const hierarchy::PageDemand demand{page, 1e9};
        const double pixels = rankedByBoxes(query, {&demand, 1}, model.pages())[0].pixels;
        EXPECT_GE(pixels, rule.casterPixels(info.bounds, info.maxError)) << page;
        EXPECT_GT(pixels, 0.1 * info.maxError) << page;
    }
}

TEST_F(ModelResidency, TheTableMustFitTheMemory) {
    const hierarchy::ModelFile model(path);
    const Bytes tables = tableBytes(model);
    EXPECT_GE(tables.count, model.pages().size() * sizeof(hierarchy::PageInfo));
    std::uint64_t links = 0;
    for (const hierarchy::PageInfo& page : model.pages())
        links += page.children.size();
    EXPECT_GE(tables.count, links * sizeof(std::uint32_t));
    ResidencyOptions tight;
    tight.memory = tables;
    try {
        const Residency residency(model, tight);
        ADD_FAILURE() << "no byte is left for pages";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("the page table alone needs more"), std::string::npos) << error.what();
    }
}

TEST(Continued, GoesOnAsItWent) {
    const lod::DetailView before = viewFrom({0, 10, 0});
    lod::DetailView now = before;
    now.eye += glm::dvec3(1, 0, 2);
    const lod::DetailView ahead = continued(before, now, 10);
    EXPECT_LT(glm::distance(ahead.eye, now.eye + glm::dvec3(10, 0, 20)), 1e-9);
    EXPECT_LT(glm::distance(ahead.basis.view, now.basis.view), 1e-9) << "it does not turn";
    EXPECT_EQ(ahead.heightPixels, now.heightPixels);
    EXPECT_EQ(ahead.tanHalfX, now.tanHalfX);
    const lod::DetailView still = continued(now, now, 10);
    EXPECT_LT(glm::distance(still.eye, now.eye), 1e-12);
}

TEST(Continued, TurnsOnAsItTurnedButNotWildly) {
    const auto looking = [](double angle) {
        lod::DetailView view;
        view.basis = cameraBasis({{0, 0, 0}, {std::sin(angle), 0, -std::cos(angle)}, {0, 1, 0}, 1});
        return view;
    };
    const lod::DetailView slow = continued(looking(0), looking(0.01), 10);
    EXPECT_NEAR(std::atan2(slow.basis.view.x, -slow.basis.view.z), 0.11, 0.01);
    const lod::DetailView spin = continued(looking(0), looking(1.5), 10);
    EXPECT_GT(glm::dot(spin.basis.view, looking(1.5).basis.view), 0)
        << "a spin is followed by less than a quarter turn";
    const lod::DetailView frames = continued(looking(0), looking(0.02), 0);
    EXPECT_LT(glm::distance(frames.basis.view, looking(0.02).basis.view), 1e-9) << "no frame ahead is now";
    EXPECT_NEAR(glm::length(slow.basis.up), 1, 1e-12);
}

} // namespace
} // namespace gnomon::frame
