// Names that go: with their object, with a process that ends early, and not once they are kept.
#include "core/file.h"
#include "core/heap.h"
#include "core/temporary_name.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <vector>

#include <unistd.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

class Name : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(directory); }

    void TearDown() override { fs::remove_all(directory); }

    std::string path(const std::string& name) const { return directory + "/" + name; }

    static std::function<bool()> makes(const std::string& path) {
        return [path] {
            return static_cast<bool>(std::ofstream(path) << 'x'); // an AtomicFile has a temporary name of its own
        };
    }

    std::string directory = testing::TempDir() + "gnomon_names_" + std::to_string(::getpid());
};

TEST_F(Name, GoesWithItsObject) {
    {
        const TemporaryName name(path("a"), makes(path("a")));
        EXPECT_TRUE(name.isHeld());
        EXPECT_EQ(name.path(), path("a"));
        EXPECT_TRUE(fs::exists(path("a")));
    }
    EXPECT_FALSE(fs::exists(path("a")));
}

TEST_F(Name, ThatWasNotMadeIsNotRemoved) {
    writeTextFile(path("theirs"), "y");
    {
        const TemporaryName name(path("theirs"), [] { return false; });
        EXPECT_FALSE(name.isHeld());
    }
    EXPECT_TRUE(fs::exists(path("theirs")));
}

TEST_F(Name, ThatIsKeptStaysAndOneThatCouldNotBeGoes) {
    {
        TemporaryName kept(path("kept"), makes(path("kept")));
        EXPECT_TRUE(kept.keep([&] {
            fs::rename(path("kept"), path("final"));
            return true;
        }));
        EXPECT_FALSE(kept.isHeld());
        TemporaryName failed(path("failed"), makes(path("failed")));
        EXPECT_FALSE(failed.keep([] { return false; }));
        EXPECT_TRUE(failed.isHeld());
    }
    EXPECT_TRUE(fs::exists(path("final")));
    EXPECT_FALSE(fs::exists(path("failed")));
}

TEST_F(Name, OfAFolderGoesOnlyWhenItIsEmpty) {
    const auto makesFolder = [](const std::string& at) { return [at] { return fs::create_directory(at); }; };
    {
        const TemporaryName empty(path("empty"), makesFolder(path("empty")));
        const TemporaryName full(path("full"), makesFolder(path("full")));
        writeTextFile(path("full/theirs"), "y");
    }
    EXPECT_FALSE(fs::exists(path("empty")));
    EXPECT_TRUE(fs::exists(path("full/theirs")));
}

TEST_F(Name, MayGoInAnyOrder) {
    std::vector<std::unique_ptr<TemporaryName>> names;
    for (const char* name : {"a", "b", "c", "d"})
        names.push_back(std::make_unique<TemporaryName>(path(name), makes(path(name))));
    names.erase(names.begin() + 1);
    EXPECT_FALSE(fs::exists(path("b")));
    names.erase(names.begin());
    names.pop_back();
    EXPECT_TRUE(fs::exists(path("c")));
    EXPECT_FALSE(fs::exists(path("a")));
    EXPECT_FALSE(fs::exists(path("d")));
}

using NameDeathTest = Name;

TEST_F(NameDeathTest, AllGoWhenTheProcessIsEnded) {
    const auto endsWithNames = [&] {
        const TemporaryName folder(path("folder"), [&] { return fs::create_directory(path("folder")); });
        const TemporaryName first(path("folder/first"), makes(path("folder/first")));
        TemporaryName kept(path("kept"), makes(path("kept")));
        kept.keep([] { return true; });
        TemporaryName::removeAllAndExit(7);
    };
    EXPECT_EXIT(endsWithNames(), testing::ExitedWithCode(7), "");
    EXPECT_FALSE(fs::exists(path("folder"))) << "newest first, so that the folder is empty when its turn comes";
    EXPECT_TRUE(fs::exists(path("kept")));
}

TEST(Heap, GivesLargePiecesBackAtOnce) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizers' allocators keep what is freed";
#endif
    returnFreedMemoryAtOnce();
    const auto residentPages = [] {
        const std::string text = readTextFile("/proc/self/statm");
        return std::stoul(text.substr(text.find(' ')));
    };
    constexpr std::size_t kBytes = std::size_t{64} << 20U;
    auto memory = std::make_unique<std::vector<char>>(kBytes, 'x');
    const std::size_t held = residentPages();
    memory.reset();
    EXPECT_LT(residentPages() + kBytes / 4096 / 2, held);
}

} // namespace
} // namespace gnomon
