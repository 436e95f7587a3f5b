// The build as a whole: the same bytes by every way to them, and nothing left behind when it fails.
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/scratch/damage_error.h"
#include "tests/pipeline/built_model.h"
#include "tests/pipeline/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::pipeline {
namespace {

namespace fs = std::filesystem;

BuildOptions smallChunks(std::uint32_t triangles) {
    BuildOptions options;
    options.chunkTriangles = triangles;
    return options;
}

/// The mesh with its vertices in another order, its triangles as they were.
read::CodeMesh shuffled(const read::CodeMesh& mesh, std::uint64_t seed) {
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    Random random(seed);
    for (std::size_t i = order.size(); i-- > 1;)
        std::swap(order[i], order[random.below(i + 1)]);
    std::vector<glm::dvec3> positions(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        positions[order[i]] = mesh.positions[i];
    std::vector<simplify::Triangle> triangles = mesh.triangles;
    for (simplify::Triangle& t : triangles)
        for (std::uint32_t& corner : t)
            corner = order[corner];
    return {std::move(positions), std::move(triangles)};
}

/// Kills the process, as `kill -9` would, when it has heard `steps` times of progress.
class DeadlyProgress final : public Progress {
public:
    explicit DeadlyProgress(int steps) : left_(steps) {}

    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override { step(); }

    void advance(std::uint64_t /*count*/) override { step(); }

private:
    void step() {
        if (--left_ >= 0) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(5)); // until records are written
        ::raise(SIGKILL);
    }

    std::atomic<int> left_;
};

/// What a build told of its temporary space.
class SpaceWatch final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override {}

    void temporarySpace(std::uint64_t bytes) override {
        std::uint64_t max = max_;
        while (max < bytes && !max_.compare_exchange_weak(max, bytes)) {
        }
    }

    std::uint64_t max() const { return max_; }

private:
    std::atomic<std::uint64_t> max_{0};
};

/// What a build said of its longest stage, which is called as it is.
class BuildWatch final : public Progress {
public:
    void stage(std::string_view name, std::string_view /*unit*/, std::uint64_t total) override {
        isBuilding_ = name == "build";
        if (isBuilding_) totals.push_back(total);
    }

    void expect(std::uint64_t total) override {
        EXPECT_TRUE(isBuilding_);
        totals.push_back(total);
    }

    void advance(std::uint64_t count) override {
        if (isBuilding_) done += count;
    }

    std::atomic<std::uint64_t> done = 0;
    std::vector<std::uint64_t> totals; // as they were taken to be, one after another

private:
    std::atomic<bool> isBuilding_ = false;
};

std::string build(read::CodeMesh mesh, const BuildOptions& options) {
    NoProgress progress;
    return buildModel(mesh, options, progress).contentHash;
}

constexpr int kToTheEnd = 1 << 30;

/// Whether a build in another process was killed by its progress; else it ended well.
bool isKilled(const read::CodeMesh& mesh, const BuildOptions& options, int steps) {
    const pid_t child = ::fork();
    if (child == 0) {
        read::CodeMesh own = mesh;
        DeadlyProgress progress(steps);
        try {
            buildModel(own, options, progress);
        } catch (...) {
            ::_exit(3);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << status;
    return WIFSIGNALED(status);
}

TEST(Pipeline, ChunksAreJoinedUntilOneRootIsLeft) {
    const BuiltModel model(read::bumpySheet(90), smallChunks(1500));
    EXPECT_LE(model.report().summary.coarsestTriangles, 1000U);
    EXPECT_EQ(model.report().irreducibleTriangles, 0U);
    EXPECT_EQ(model.summary().levels.front().triangles, 90U * 90 * 2);
    EXPECT_GT(model.report().temporaryBytes, 0U);
}

TEST(Pipeline, TellsWhileItRunsHowMuchTemporarySpaceIsInUse) {
    const TestFolder folder;
    read::CodeMesh mesh = read::bumpySheet(50);
    BuildOptions options = smallChunks(600);
    options.output = folder.file("m.gnm");
    SpaceWatch watch;
    const BuildReport report = buildModel(mesh, options, watch);
    EXPECT_EQ(report.temporaryBytes, watch.max());
    EXPECT_GT(watch.max(), mesh.triangles.size() * 12);
}

TEST(Pipeline, KnowsBetterAfterEachRoundHowMuchThereIsToDo) {
    for (const read::CodeMesh& mesh : {read::bumpySheet(140), read::strewnBoxes(3000)}) {
        const TestFolder folder;
        read::CodeMesh own = mesh;
        BuildOptions options = smallChunks(600);
        options.output = folder.file("m.gnm");
        BuildWatch watch;
        buildModel(own, options, watch);
        ASSERT_GE(watch.totals.size(), 3U) << "a total a round";
        const auto done = static_cast<double>(watch.done);
        EXPECT_EQ(watch.totals.front(), 2 * mesh.triangles.size());
        const auto isOffBy = [&](std::uint64_t total) { return std::abs(static_cast<double>(total) - done); };
        EXPECT_LT(isOffBy(watch.totals[1]), isOffBy(watch.totals.front()));
        EXPECT_LT(isOffBy(watch.totals.back()), 0.6 * isOffBy(watch.totals.front()));
    }
}

TEST(Pipeline, SameBytesOnDiskAndInMemoryForAnyThreadsAndMemory) {
    for (const read::CodeMesh& mesh : {read::bumpySheet(50), read::strewnBoxes(400)}) {
        std::set<std::string> hashes;
        for (const bool isInMemory : {false, true})
            for (const int threads : {1, 3})
                for (const Bytes memory : {mebibytes(200), gibibytes(4)}) {
                    BuildOptions options = smallChunks(600);
                    options.isInMemory = isInMemory;
                    options.threads = threads;
                    options.memory = memory;
                    hashes.insert(BuiltModel(mesh, options).report().contentHash);
                }
        EXPECT_EQ(hashes.size(), 1U);
    }
}

TEST(Pipeline, SameBytesForVerticesInAnyOrder) {
    const read::CodeMesh mesh = read::bumpySheet(60);
    const std::string expected = BuiltModel(mesh, smallChunks(900)).report().contentHash;
    for (const std::uint64_t seed : {1U, 2U, 3U})
        EXPECT_EQ(BuiltModel(shuffled(mesh, seed), smallChunks(900)).report().contentHash, expected);
}

TEST(Pipeline, BordersOfOneRoundAreFreeInTheNext) {
    const BuiltModel model(read::bumpySheet(260), smallChunks(16'000));
    ASSERT_GE(model.report().rounds.size(), 2U);
    EXPECT_GE(model.report().rounds.front().nodes, 3U);
    for (const RoundReport& round : model.report().rounds) {
        if (round.nodes == 1) continue;
        EXPECT_GT(round.locked, 0U);
        EXPECT_LE(2 * round.lockedBefore, round.locked) << "only where borders cross";
    }
    EXPECT_EQ(model.report().rounds.back().nodes, 1U);
    EXPECT_EQ(model.report().irreducibleTriangles, 0U);
}

TEST(Pipeline, GoesOnAfterBeingKilledAnywhere) {
    const read::CodeMesh mesh = read::bumpySheet(120); // several nodes after the first round
    const TestFolder folder;
    BuildOptions options = smallChunks(500);
    options.output = folder.file("m.gnm");
    options.inputKey = "the sheet";
    // All builds are in processes of their own: one that has had threads must not be copied.
    ASSERT_FALSE(isKilled(mesh, options, kToTheEnd));
    const std::string expected = hierarchy::ModelFile(options.output).contentHash();
    options.isResumed = true;
    Random random(5);
    int killed = 0;
    for (int round = 0; round < 8; ++round) {
        fs::remove(options.output);
        // Killed again and again, each time a little later.
        int steps = 1 + static_cast<int>(random.below(12));
        while (isKilled(mesh, options, steps)) {
            ++killed;
            EXPECT_FALSE(fs::exists(options.output));
            steps += static_cast<int>(random.below(30));
        }
        EXPECT_EQ(hierarchy::ModelFile(options.output).contentHash(), expected);
        EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"});
    }
    EXPECT_GT(killed, 8);
}

/// Damages one of the scratch files or the log in `folder` in one of several ways.
void damageOne(const fs::path& folder, Random& random) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != "lock") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    const std::string path = files[random.below(files.size())].string();
    std::string bytes = readTextFile(path);
    const std::size_t place = random.below(bytes.size() + 1);
    const std::size_t length = std::min<std::size_t>(random.below(3) == 0 ? bytes.size() : 512, bytes.size() - place);
    switch (random.below(6)) {
    case 0: // as after a power cut
        bytes.replace(place, length, length, '\0');
        break;
    case 1:
        if (length > 0) bytes[place] = static_cast<char>(bytes[place] ^ 1 << random.below(8));
        break;
    case 2:
        bytes.resize(place);
        break;
    case 3: // the block of another place
        bytes.replace(place, length, bytes.substr(random.below(bytes.size() - length + 1), length));
        break;
    case 4:
        bytes.insert(place, "more");
        break;
    default:
        fs::remove(path);
        return;
    }
    writeTextFile(path, bytes);
}

TEST(Pipeline, DamagedTemporaryDataDoNotChangeAResumedBuild) {
    const read::CodeMesh mesh = read::bumpySheet(50);
    const TestFolder folder;
    BuildOptions options = smallChunks(400);
    options.output = folder.file("m.gnm");
    ASSERT_FALSE(isKilled(mesh, options, kToTheEnd));
    const std::string expected = hierarchy::ModelFile(options.output).contentHash();
    const fs::path state = options.output + ".building";
    const fs::path kept = folder.file("kept");
    Random random(11);
    int damaged = 0;
    options.onDamage = [&](const std::string& damage) {
        ++damaged;
        EXPECT_NE(damage.find(".building"), std::string::npos) << damage;
    };
    for (const int steps : {30, 60, 90}) {
        options.isResumed = false;
        ASSERT_TRUE(isKilled(mesh, options, steps));
        fs::remove_all(kept);
        fs::rename(state, kept);
        options.isResumed = true;
        for (int i = 0; i < 14; ++i) {
            fs::copy(kept, state);
            damageOne(state, random);
            fs::remove(options.output);
            ASSERT_EQ(build(mesh, options), expected) << i;
            EXPECT_FALSE(fs::exists(state));
        }
    }
    EXPECT_GT(damaged, 5);
}

TEST(Pipeline, AnErrorNamesTemporaryDataThatAreDamagedWhileABuildRuns) {
    read::CodeMesh mesh = read::bumpySheet(50);
    const TestFolder folder;
    BuildOptions options = smallChunks(400);
    options.output = folder.file("m.gnm");
    const std::string scratch = options.output + ".building/scratch.0";

    class Damager final : public Progress {
    public:
        explicit Damager(std::string path) : path_(std::move(path)) {}

        void stage(std::string_view name, std::string_view /*unit*/, std::uint64_t /*total*/) override {
            if (name != "borders") return;
            File file(path_, File::Mode::Update);
            file.writeAt(0, std::vector<std::byte>(file.size()));
        }

        void advance(std::uint64_t /*count*/) override {}

    private:
        std::string path_;
    };

    Damager damager(scratch);
    try {
        buildModel(mesh, options, damager);
        ADD_FAILURE() << "no error";
    } catch (const scratch::DamageError& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.rfind(scratch + ": byte ", 0), 0U) << text;
        EXPECT_NE(text.find(" bytes of temporary data are damaged: expected checksum "), std::string::npos) << text;
        EXPECT_NE(text.find(", found checksum "), std::string::npos) << text;
    }
    EXPECT_EQ(folder.names(), std::set<std::string>{});
}

TEST(Pipeline, AResumedBuildOfSomethingElseIsRefusedAndTouchesNothing) {
    const read::CodeMesh mesh = read::bumpySheet(60);
    const TestFolder folder;
    BuildOptions options = smallChunks(1000);
    options.output = folder.file("m.gnm");
    options.inputKey = "input 1 bytes 17, input 1 changed yesterday";
    ASSERT_TRUE(isKilled(mesh, options, 20));
    options.isResumed = true;
    const std::string start = options.output + ".building: cannot resume, because the input or the options changed: ";
    const auto refusal = [&](const BuildOptions& other) -> std::string {
        try {
            build(mesh, other);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    BuildOptions otherInput = options;
    otherInput.inputKey = "input 1 bytes 17, input 1 changed today";
    EXPECT_EQ(refusal(otherInput), start + "input 1 changed: expected today, found yesterday");
    otherInput.inputKey += ", input 2 bytes 4";
    EXPECT_EQ(
        refusal(otherInput),
        start + "input 1 changed: expected today, found yesterday; input 2 bytes: expected 4, found nothing");
    BuildOptions otherOptions = options;
    otherOptions.level.clusterTriangles = 64;
    EXPECT_EQ(refusal(otherOptions), start + "cluster_triangles: expected 64, found 128");
    EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm.building"});
    build(mesh, options);
    EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"});
}

TEST(Pipeline, AFailingWriteIsOneErrorAndTheOldOutputStays) {
    const read::CodeMesh mesh = read::bumpySheet(40);
    const TestFolder folder;
    BuildOptions options = smallChunks(1000);
    options.output = folder.file("m.gnm");
    writeTextFile(options.output, "the old one");
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit whole{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &whole), 0);
    int failed = 0;
    for (const bool isInMemory : {false, true}) // the temporary files, and the output alone
        for (const rlim_t limit : {1000U, 10'000U}) {
            options.isInMemory = isInMemory;
            const rlimit small{limit, whole.rlim_max};
            ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
            try {
                build(mesh, options);
            } catch (const Error& error) {
                ++failed;
                EXPECT_NE(std::string(error.what()).find("cannot write"), std::string::npos) << error.what();
            }
            ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &whole), 0);
            EXPECT_EQ(folder.names(), std::set<std::string>{"m.gnm"}) << limit;
            EXPECT_EQ(readTextFile(options.output), "the old one") << limit;
        }
    EXPECT_EQ(failed, 4);
}

TEST(Pipeline, TwoBuildsOfOneOutputDoNotMix) {
    const TestFolder folder;
    BuildOptions options = smallChunks(1000);
    options.output = folder.file("m.gnm");
    fs::create_directories(options.output + ".building");
    File lock(options.output + ".building/lock", File::Mode::Create);
    ASSERT_TRUE(lock.tryLock());
    EXPECT_THROW(build(read::bumpySheet(20), options), Error);
    EXPECT_TRUE(fs::exists(options.output + ".building/lock"));
}

TEST(Pipeline, ClearsAwayWhatKilledBuildsHadHalfWrittenButNotWhatLivingOnesHave) {
    const TestFolder folder;
    BuildOptions options = smallChunks(1000);
    options.output = folder.file("m.gnm");
    options.temporaryFolder = folder.file("elsewhere");
    const std::string killed = options.output + ".2147483647.partial"; // more than any process is called
    const std::string living = options.output + "." + std::to_string(::getppid()) + ".partial";
    for (const std::string& half : {killed, living})
        writeTextFile(half, "half");
    build(read::bumpySheet(20), options);
    EXPECT_FALSE(fs::exists(killed));
    EXPECT_TRUE(fs::exists(living));
}

TEST(Pipeline, AVertexThatNoTriangleUsesDoesNotSetTheGrid) {
    const read::CodeMesh sheet = read::bumpySheet(30);
    std::vector<glm::dvec3> positions = sheet.positions;
    positions.emplace_back(1e9, -1e300, 0);
    const BuiltModel expected(sheet, smallChunks(1000));
    const BuiltModel found(read::CodeMesh(positions, sheet.triangles), smallChunks(1000));
    EXPECT_EQ(found.summary().grid.stepExponent, expected.summary().grid.stepExponent);
    EXPECT_EQ(found.summary().grid.origin, expected.summary().grid.origin);
    EXPECT_EQ(found.report().summary.dropped, expected.report().summary.dropped);
}

// Scanners write vertices at NaN where they saw nothing.
TEST(Pipeline, AVertexThatIsNotFiniteIsIgnoredWhereNoTriangleUsesIt) {
    const read::CodeMesh sheet = read::bumpySheet(30);
    const BuiltModel expected(sheet, smallChunks(1000));
    std::vector<glm::dvec3> positions = sheet.positions;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    positions.emplace_back(nan, 0, nan);
    positions.emplace_back(0, std::numeric_limits<double>::infinity(), 0);
    const BuiltModel found(read::CodeMesh(positions, sheet.triangles), smallChunks(1000));
    EXPECT_EQ(found.summary().grid.origin, expected.summary().grid.origin);
    EXPECT_EQ(found.report().fileBytes, expected.report().fileBytes);
    std::vector<simplify::Triangle> triangles = sheet.triangles;
    triangles.push_back({0, 1, static_cast<std::uint32_t>(positions.size() - 1)});
    try {
        const BuiltModel bad(read::CodeMesh(positions, triangles), smallChunks(1000));
        FAIL() << "it passed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("a coordinate of vertex 962 is not finite"), std::string::npos)
            << error.what();
    }
}

TEST(Pipeline, CoordinatesWhoseSquaresNoDoubleHoldsAreRefused) {
    const TestFolder folder;
    BuildOptions options = smallChunks(1000);
    options.output = folder.file("m.gnm");
    EXPECT_NO_THROW(build(read::bumpySheet(5, 1e90), options));
    try {
        build(read::bumpySheet(5, 1e300), options);
        FAIL() << "they passed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("expected at most 1e100, found 1e+300"), std::string::npos)
            << error.what();
    }
}

// Of all sizes of chunks and all that is left over beside one: a chunk is always under way, and the share is kept.
} // namespace
} // namespace gnomon::pipeline
