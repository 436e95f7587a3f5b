#include "bench/child_process.h"

#include "core/error.h"
#include "core/stopwatch.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::bench {

namespace {

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// A pipe whose ends are closed at the end.
class Pipe {
public:
    Pipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
            throw Error(std::string("cannot make a pipe: ") + std::strerror(errno));
    }

    ~Pipe() {
        ::close(ends_[0]);
        closeWriting();
    }

    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    Pipe(Pipe&&) = delete;
    Pipe& operator=(Pipe&&) = delete;

    int writing() const { return ends_[1]; }

    void closeWriting() {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }

    /// Reads until all writers have closed their end.
    std::string readAll() const {
        std::string text;
        std::array<char, 4096> buffer{};
        for (;;) {
            const ssize_t count = ::read(ends_[0], buffer.data(), buffer.size());
            if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
            if (count == 0 || (count < 0 && errno != EINTR)) return text;
        }
    }

private:
    std::array<int, 2> ends_{-1, -1};
};

} // namespace

ChildResult runChild(const std::vector<std::string>& words) {
    std::vector<std::string> copies = words;
    std::vector<char*> arguments;
    arguments.reserve(copies.size() + 1);
    for (std::string& word : copies)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    Pipe pipe;
    posix_spawn_file_actions_t actions{};
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, pipe.writing(), STDOUT_FILENO);
    const Stopwatch clock;
    pid_t process = 0;
    const int failure = ::posix_spawn(&process, copies.front().c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) throw Error(copies.front(), std::string("cannot start this program: ") + std::strerror(failure));
    pipe.closeWriting();
    ChildResult result;
    result.output = pipe.readAll();
    int status = 0;
    rusage usage{};
    while (::wait4(process, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    result.wallSeconds = clock.elapsed().count / 1e3;
    result.cpuSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    result.peakBytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    constexpr int kSignalBase = 128;
    result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status);
    return result;
}

std::string ownProgram() {
    return std::filesystem::read_symlink("/proc/self/exe").string();
}

} // namespace gnomon::bench
