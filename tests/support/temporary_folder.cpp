// Gives each test program a folder of its own for temporary files, before anything else of it runs, and takes it away
// with all that the tests have left there. gtest and the standard library find it by the environment.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace {

class TemporaryFolder {
public:
    TemporaryFolder() {
        if (::mkdtemp(path_.data()) == nullptr) std::abort();
        ::setenv("TMPDIR", path_.c_str(), 1);
        ::setenv("TEST_TMPDIR", (path_ + "/").c_str(), 1);
    }

    ~TemporaryFolder() {
        std::error_code ignored;
        if (::getpid() == owner_) std::filesystem::remove_all(path_, ignored);
    }

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    TemporaryFolder(TemporaryFolder&&) = delete;
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;

private:
    static std::string base() {
        const char* folder = std::getenv("TMPDIR");
        return folder != nullptr ? folder : "/tmp";
    }

    std::string path_ = base() + "/gnomon_tests_XXXXXX";
    pid_t owner_ = ::getpid(); // a child that a test forks off must not take the folder away
};

/// First of all constructors, since those of other files ask for the folder already; so it goes last.
[[gnu::constructor(101)]] void makeFolder() {
    static const TemporaryFolder folder;
}

} // namespace
