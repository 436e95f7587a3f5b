// The interface through which long tasks report their progress. The application shows a progress bar, writes JSON
// lines, or ignores the reports.
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

/// A receiver of progress reports. Any thread can call its functions, so implementations must lock.
class Progress {
public:
    Progress() = default;
    virtual ~Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;

    /// Begins a new stage of the task. `total` is the amount of work in `unit`, for example triangles, bytes or frames.
    virtual void stage(std::string_view name, std::string_view unit, std::uint64_t total) = 0;

    /// Corrects the total amount of work of the current stage.
    virtual void expect(std::uint64_t /*total*/) {}

    /// Reports that `count` more units of the current stage are finished. Throws gnomon::Interrupted if the user
    /// requested a stop.
    virtual void advance(std::uint64_t count) = 0;

    /// Reports how many bytes the temporary files of the task occupy now.
    virtual void temporarySpace(std::uint64_t /*bytes*/) {}
};

/// The exception that `Progress::advance` throws after Ctrl-C. It unwinds the stack, so that destructors remove
/// unfinished files.
struct Interrupted {};

/// A progress receiver that ignores all reports.
class NoProgress final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override {}
};

} // namespace gnomon
