#include "app/commands.h"
#include "app/interruption.h"
#include "core/heap.h"
#include "core/stopwatch.h"

#include <cstdio>
#include <mutex>
#include <optional>

#include <unistd.h>

namespace gnomon::app {

namespace {

constexpr Milliseconds kBetweenShown{100};

/// Displays progress on stderr: stage, finished and total units, rate, memory and remaining time. It is updated at most
/// ten times per second.
class StderrProgress final : public Progress {
public:
    enum class Style { Bar, Json, None };

    StderrProgress(Style style, Polling polling) : style_(style) {
        if (polling == Polling::Yes) polled_.emplace();
    }

    ~StderrProgress() override {
        const std::scoped_lock lock(mutex_);
        finishStage();
    }

    StderrProgress(const StderrProgress&) = delete;
    StderrProgress& operator=(const StderrProgress&) = delete;
    StderrProgress(StderrProgress&&) = delete;
    StderrProgress& operator=(StderrProgress&&) = delete;

    void stage(std::string_view name, std::string_view unit, std::uint64_t total) override {
        const std::scoped_lock lock(mutex_);
        finishStage();
        name_ = name;
        unit_ = unit;
        total_ = total;
        done_ = 0;
        sinceStart_ = {};
        sinceShown_ = {};
    }

    void expect(std::uint64_t total) override {
        const std::scoped_lock lock(mutex_);
        total_ = total;
    }

    void advance(std::uint64_t count) override {
        if (isInterrupted()) throw Interrupted{};
        const std::scoped_lock lock(mutex_);
        done_ += count;
        if (name_.empty() || sinceShown_.elapsed() < kBetweenShown) return;
        sinceShown_ = {};
        show();
    }

    void temporarySpace(std::uint64_t bytes) override {
        const std::scoped_lock lock(mutex_);
        temporaryBytes_ = bytes;
    }

private:
    void finishStage() {
        if (name_.empty() || style_ == Style::None) return;
        show();
        if (style_ == Style::Bar) std::fputc('\n', stderr);
        name_.clear();
    }

    void show() const {
        const std::uint64_t total = std::max(total_, done_); // a total can be an estimate that is too small
        const double seconds = sinceStart_.elapsed().count / 1000;
        const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
        const double left = rate > 0 ? static_cast<double>(total - done_) / rate : 0;
        if (style_ == Style::Json) {
            std::fprintf(
                stderr,
                "{\"stage\": \"%s\", \"unit\": \"%s\", \"done\": %llu, \"total\": %llu, \"per_second\": %.0f, "
                "\"memory_bytes\": %llu, \"temporary_bytes\": %llu, \"seconds_left\": %.1f}\n",
                name_.c_str(),
                unit_.c_str(),
                static_cast<unsigned long long>(done_),
                static_cast<unsigned long long>(total),
                rate,
                static_cast<unsigned long long>(residentSize().count),
                static_cast<unsigned long long>(temporaryBytes_),
                left);
        } else if (style_ == Style::Bar) {
            constexpr int kWidth = 24;
            const double fraction = total > 0 ? static_cast<double>(done_) / static_cast<double>(total) : 0;
            const int filled = static_cast<int>(fraction * kWidth);
            std::string bar(static_cast<std::size_t>(filled), '#');
            bar.resize(kWidth, '.');
            std::fprintf(
                stderr,
                "\r\033[K%-10s [%s] %s/%s %s  %s/s  %s%s  %.0f s left",
                name_.c_str(),
                bar.c_str(),
                readableCount(done_).c_str(),
                readableCount(total).c_str(),
                unit_.c_str(),
                readableCount(static_cast<std::uint64_t>(rate)).c_str(),
                readableBytes(residentSize()).c_str(),
                temporaryBytes_ > 0 ? (" + " + readableBytes({temporaryBytes_}) + " temporary").c_str() : "",
                left);
        }
    }

    std::optional<PolledInterruption> polled_;
    Style style_;
    std::mutex mutex_;
    std::string name_;
    std::string unit_;
    std::uint64_t total_ = 0;
    std::uint64_t done_ = 0;
    std::uint64_t temporaryBytes_ = 0;
    Stopwatch sinceStart_;
    Stopwatch sinceShown_;
};

} // namespace

void addCommonOptions(CLI::App& command, CommonOptions& options) {
    command.add_option("--threads", options.threads, "Number of threads; 0 is one per core")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--progress", options.progress, "Progress on stderr: auto, bar, json or none")
        ->check(CLI::IsMember({"auto", "bar", "json", "none"}))
        ->type_name("STYLE")
        ->capture_default_str();
}

std::unique_ptr<Progress> makeProgress(const CommonOptions& options, Polling polling) {
    using Style = StderrProgress::Style;
    Style style = Style::None;
    if (options.progress == "bar" || (options.progress == "auto" && ::isatty(STDERR_FILENO) != 0)) style = Style::Bar;
    if (options.progress == "json") style = Style::Json;
    return std::make_unique<StderrProgress>(style, polling);
}

} // namespace gnomon::app
