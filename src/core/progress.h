// The interface through which long tasks report progress. The application shows a bar, writes JSON lines, or ignores
// it.
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

/// A receiver of progress. Any thread can call it, so implementations lock.
class Progress {
public:
    Progress() = default;
    virtual ~Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;

    /// Begins a new stage. `total` is its number of units, for example of triangles, bytes or frames.
    virtual void stage(std::string_view name, std::string_view unit, std::uint64_t total) = 0;

    /// Corrects the total number of units of the current stage.
    virtual void expect(std::uint64_t /*total*/) {}

    /// Reports `count` more finished units of the stage. Throws gnomon::Interrupted if the user requested a stop.
    virtual void advance(std::uint64_t count) = 0;

    /// Reports the number of bytes that temporary files use now.
    virtual void temporarySpace(std::uint64_t /*bytes*/) {}
};

/// Thrown by `Progress::advance` after Ctrl-C, so that the stack unwinds and removes unfinished files.
struct Interrupted {};

/// A receiver that ignores all progress.
class NoProgress final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override {}
};

} // namespace gnomon
