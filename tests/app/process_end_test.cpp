// How a process of ours speaks and ends, each time in a child of its own: messages, lost output, signals.
#include "app/console.h"
#include "app/interruption.h"
#include "app/oracle_option.h"
#include "core/error.h"
#include "core/file.h"
#include "core/temporary_name.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::app {
namespace {

/// How a child ended, and what it had said on stderr.
struct Ending {
    int status = -1;
    int signal = 0;
    std::string said;
};

/// Runs `action` in a child, which ends with 7 if `action` returns.
Ending inChild(const std::function<void()>& action) {
    const std::string path = testing::TempDir() + "gnomon_process_end_" + std::to_string(::getpid());
    const pid_t child = ::fork();
    if (child == 0) {
        const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (file < 0 || ::dup2(file, STDERR_FILENO) < 0) ::_exit(8); // stderr stays without a buffer
        action();
        std::fflush(stderr);
        ::_exit(7);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Ending ending;
    if (WIFEXITED(status)) ending.status = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
    std::ifstream file(path);
    ending.said.assign(std::istreambuf_iterator<char>(file), {});
    std::filesystem::remove(path);
    return ending;
}

const std::string kSaid = std::string("gnomon: ") + kInterrupted + "\n";

TEST(Message, IsOneLineWithoutControlCharacters) {
    const auto printed = [](const std::string& text) { return inChild([&] { printMessage(text); }).said; };
    EXPECT_EQ(printed("a model"), "gnomon: a model\n");
    for (const std::string& text :
         {std::string("two\nlines"),
          std::string("a\rb"),
          std::string("\033[31mred"),
          std::string("bell\a"),
          std::string("%s%n")}) {
        const std::string said = printed(text);
        EXPECT_TRUE(said.starts_with("gnomon: ") && said.ends_with("\n")) << said;
        for (const char c : said.substr(0, said.size() - 1))
            EXPECT_GE(static_cast<unsigned char>(c), 0x20U) << said;
    }
    EXPECT_EQ(printed("100%s"), "gnomon: 100%s\n");
}

TEST(Output, ThatIsLostIsToldWithWhatIsKept) {
    const auto said = [](const std::string& kept) {
        return inChild([&] {
                   if (std::freopen("/dev/full", "w", stdout) == nullptr) return;
                   std::fputs("text", stdout);
                   try {
                       requirePrinted(kept);
                   } catch (const Error& error) {
                       std::fputs(error.what(), stderr);
                   }
               })
            .said;
    };
    EXPECT_TRUE(said("").starts_with("stdout: cannot write: ")) << said("");
    EXPECT_EQ(said("").find(';'), std::string::npos) << "nothing was kept";
    EXPECT_TRUE(
        said("the model o.gnm is complete").ends_with("; the model o.gnm is complete, but its summary is lost"));
    EXPECT_EQ(
        inChild([] {
            if (std::freopen("/dev/null", "w", stdout) == nullptr) return;
            std::fputs("text", stdout);
            requirePrinted();
        }).status,
        7)
        << "what has arrived is not complained of";
}

TEST(StandardDescriptors, ThatAreClosedAreNoFileOfOurs) {
    for (const std::vector<int>& closed : {std::vector<int>{0}, {1}, {2}, {0, 1}, {1, 2}, {0, 1, 2}}) {
        const Ending ending = inChild([&] {
            for (const int descriptor : closed)
                ::close(descriptor);
            occupyStandardDescriptors();
            const int next = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
            bool isSound = next > 2;
            char byte = 0;
            for (const int descriptor : closed) // their use stays an error
                isSound = isSound && (descriptor == 0 ? ::read(0, &byte, 1) : ::write(descriptor, &byte, 1)) < 0;
            ::_exit(isSound ? 42 : 43);
        });
        EXPECT_EQ(ending.status, 42) << closed.size() << " from " << closed.front();
    }
    EXPECT_EQ(
        inChild([] {
            occupyStandardDescriptors();
            printMessage("still here");
        }).said,
        "gnomon: still here\n");
}

TEST(Interruption, ByAnySignalRemovesWhatIsHalfWrittenAndSaysSo) {
    const std::string path = testing::TempDir() + "gnomon_interrupted_" + std::to_string(::getpid());
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        const Ending ending = inChild([&] {
            std::signal(signal, SIG_DFL);
            endCleanlyOnSignals();
            AtomicFile file(path);
            std::raise(signal);
        });
        EXPECT_EQ(ending.status, 1) << signal;
        EXPECT_EQ(ending.said, kSaid) << signal;
        for (const auto& entry : std::filesystem::directory_iterator(testing::TempDir()))
            EXPECT_EQ(entry.path().string().find(path), std::string::npos) << entry.path();
    }
}

TEST(Interruption, IsButNotedWhileItIsPolledUntilItComesTwice) {
    const Ending once = inChild([] {
        endCleanlyOnSignals();
        const PolledInterruption polled;
        const bool before = isInterrupted();
        std::raise(SIGINT);
        ::_exit(!before && isInterrupted() ? 42 : 43);
    });
    EXPECT_EQ(once.status, 42);
    EXPECT_EQ(once.said, "");
    const Ending twice = inChild([] {
        endCleanlyOnSignals();
        const PolledInterruption polled;
        std::raise(SIGINT);
        std::raise(SIGTERM);
    });
    EXPECT_EQ(twice.status, 1);
    EXPECT_EQ(twice.said, kSaid);
    const Ending after = inChild([] {
        endCleanlyOnSignals();
        {
            const PolledInterruption outer;
            const PolledInterruption inner;
        }
        std::raise(SIGINT);
    });
    EXPECT_EQ(after.status, 1) << "nobody polls any more";
}

TEST(Interruption, LeavesIgnoredWhatAShellIgnores) {
    for (const int signal : {SIGHUP, SIGPIPE}) {
        const Ending ending = inChild([&] {
            std::signal(signal, SIG_IGN);
            endCleanlyOnSignals();
            std::raise(signal);
            ::_exit(isInterrupted() ? 43 : 42);
        });
        EXPECT_EQ(ending.status, 42) << signal;
    }
    EXPECT_EQ(
        inChild([] {
            std::signal(SIGINT, SIG_IGN);
            endCleanlyOnSignals();
            std::raise(SIGINT);
        }).status,
        1)
        << "Ctrl-C is for us all the same";
}

TEST(Termination, ForWantOfMemoryOrThreadsIsAFailureAndAllElseAFault) {
    const auto ended = [](void (*raise)()) {
        return inChild([&] {
            endCleanlyOnSignals();
            [&]() noexcept { raise(); }();
        });
    };
    const Ending memory = ended([] { throw std::bad_alloc(); });
    EXPECT_EQ(memory.status, 1);
    EXPECT_EQ(memory.said, "gnomon: out of memory\n");
    const Ending threads =
        ended([] { throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)); });
    EXPECT_EQ(threads.status, 1);
    EXPECT_TRUE(threads.said.starts_with("gnomon: the operating system refused: ")) << threads.said;
    const Ending fault = ended([] { throw std::logic_error("a fault"); });
    EXPECT_EQ(fault.signal, SIGABRT);
    EXPECT_EQ(fault.said, "gnomon: ended by an unexpected error: a fault\n");
    EXPECT_EQ(ended([] { throw 3; }).said, "gnomon: ended by an unexpected error of unknown type\n");
}

TEST(OracleOption, IsAFlagOrNamesHowFarItGoes) {
    const auto parsed = [](std::vector<std::string> words) {
        CLI::App command;
        std::string model;
        command.add_option("MODEL", model);
        validation::GroundTruth groundTruth = validation::GroundTruth::None;
        addOracleOption(command, groundTruth);
        std::reverse(words.begin(), words.end()); // as CLI11 takes a vector
        command.parse(words);
        return groundTruth;
    };
    EXPECT_EQ(parsed({"m.gnm"}), validation::GroundTruth::None);
    EXPECT_EQ(parsed({"m.gnm", "--oracle"}), validation::GroundTruth::SameDetail);
    EXPECT_NE(parsed({"m.gnm", "--oracle", "full"}), validation::GroundTruth::SameDetail);
    EXPECT_NE(parsed({"m.gnm", "--oracle", "full"}), validation::GroundTruth::None);
    EXPECT_THROW(parsed({"--oracle", "m.gnm"}), CLI::ValidationError) << "the model is no mode";
}

} // namespace
} // namespace gnomon::app
