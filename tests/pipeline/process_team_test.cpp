// A model that several processes build is that of one, in whatever order and wherever their tasks run.
#include "core/error.h"
#include "hierarchy/model_file.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/pipeline/tasks/process_team.h"
#include "preprocess/pipeline/tasks/task_work.h"
#include "tests/pipeline/test_folder.h"
#include "tests/support/code_mesh.h"

#include <gtest/gtest.h>

#include <utility>

namespace gnomon::pipeline {
namespace {

/// Runs tasks backwards, each as another process would: from bytes alone, with a part of the scratch files of its own.
class BackwardTeam final : public ProcessTeam {
public:
    /// Fails at its `fatalTask`th task.
    BackwardTeam(read::MeshSource& source, std::uint32_t processes, std::uint64_t fatalTask = ~std::uint64_t{0})
        : source_(source), processes_(processes), fatalTask_(fatalTask) {}

    std::uint32_t processCount() const override { return processes_; }

    void gather(const BuildOptions& /*options*/, std::size_t /*threads*/, Progress& /*progress*/) override {}

    void begin(const ScratchPlace& place, Progress& /*progress*/) override {
        for (std::uint32_t i = 1; i < processes_; ++i) {
            parts_.push_back(std::make_unique<scratch::PartedScratch>(place.stem, place.firstPart + i, space_));
            work_.push_back(std::make_unique<TaskWork>(source_, levels::LevelOptions(), *parts_.back(), progress_));
        }
    }

    void tell(const TaskFacts& facts) override {
        for (const auto& work : work_)
            work->tell(decodedFacts(encoded(facts)));
    }

    void run(const TaskPhase& phase, const Perform& perform) override {
        for (auto task = phase.tasks.rbegin(); task != phase.tasks.rend(); ++task) {
            const std::vector<std::byte> input = phase.input(*task);
            const std::size_t who = *task % processes_;
            if (tasks_++ == fatalTask_) throw Error("this process fails");
            phase.take(*task, who == 0 ? perform(phase.kind, input) : work_[who - 1]->perform(phase.kind, input));
            ++share_.tasks;
        }
    }

    TeamShare endPhase() override { return std::exchange(share_, {}); }

    std::uint64_t tasks() const { return tasks_; }

private:
    read::MeshSource& source_;
    std::uint32_t processes_;
    std::uint64_t fatalTask_;
    std::uint64_t tasks_ = 0;
    NoProgress progress_;
    scratch::TemporarySpace space_{progress_};
    std::vector<std::unique_ptr<scratch::PartedScratch>> parts_;
    std::vector<std::unique_ptr<TaskWork>> work_;
    TeamShare share_;
};

class Team : public testing::Test {
protected:
    Team() {
        options.chunkTriangles = 500;
        options.output = folder.file("m.gnm");
        options.inputKey = "the sheet";
    }

    std::string built(ProcessTeam& team) { return buildModel(mesh, options, team, progress).contentHash; }

    std::string builtAlone() {
        read::CodeMesh whole = read::bumpySheet(80);
        return buildModel(whole, options, progress).contentHash;
    }

    NoProgress progress;
    TestFolder folder;
    BuildOptions options;
    read::CodeMesh mesh = read::bumpySheet(80);
};

TEST_F(Team, BuildsTheBytesOfOneProcess) {
    const std::string expected = builtAlone();
    for (const std::uint32_t processes : {1U, 2U, 5U, 1U, 2U, 5U}) {
        BackwardTeam team(mesh, processes);
        EXPECT_EQ(built(team), expected) << processes;
        EXPECT_GT(team.tasks(), 20U);
        EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"});
        if (processes == 5) mesh.withRanges(); // and then the source, too, is sorted in tasks
    }
}

TEST_F(Team, ThatFailsLeavesWhatAnotherGoesOnWith) {
    const std::string expected = builtAlone();
    BackwardTeam whole(mesh, 1);
    EXPECT_EQ(built(whole), expected);
    std::filesystem::remove(options.output);
    options.isResumed = true;
    std::uint64_t done = 0;
    std::uint32_t processes = 2;
    std::string hash;
    while (hash.empty()) {
        BackwardTeam team(mesh, processes, 60); // the exchange of borders, and a few nodes
        try {
            hash = built(team);
        } catch (const Error&) {
            EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm.building"});
        }
        done += team.tasks();
        processes = 1 + (processes + 1) % 4;
        ASSERT_LT(done, 10 * whole.tasks()) << "it does not come on";
    }
    EXPECT_EQ(hash, expected);
    EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"});
    std::filesystem::remove(options.output);
    BackwardTeam team(mesh, 3, 70);
    EXPECT_THROW(built(team), Error);
    EXPECT_EQ(builtAlone(), expected) << "one process goes on with what many left";
    EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"});
}

// The last tasks write pages to a file that has no name yet.
TEST_F(Team, ThatFailsAtTheLastPagesKeepsTheModelThatWasThere) {
    const std::string expected = builtAlone();
    BackwardTeam whole(mesh, 3);
    EXPECT_EQ(built(whole), expected);
    for (const std::uint64_t fromEnd : {1U, 2U, 3U}) {
        BackwardTeam team(mesh, 3, whole.tasks() - fromEnd);
        EXPECT_THROW(built(team), Error);
        EXPECT_EQ(folder.names(), (std::set<std::string>{"m.gnm", "m.gnm.building"}));
        EXPECT_EQ(hierarchy::ModelFile(options.output).contentHash(), expected);
        options.isResumed = true;
        BackwardTeam next(mesh, 2);
        EXPECT_EQ(built(next), expected);
        EXPECT_LT(next.tasks(), 10U) << "pages alone are written anew";
        EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"});
        options.isResumed = false;
    }
}

} // namespace
} // namespace gnomon::pipeline
