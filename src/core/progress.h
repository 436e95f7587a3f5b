// Where long work says how far it is; what is done with that (a bar, JSON lines, nothing) is the app's business.
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

/// Receives progress. Calls may come from any thread; implementations lock.
class Progress {
public:
    Progress() = default;
    virtual ~Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;

    /// A new stage of `total` units (triangles, bytes, frames) begins.
    virtual void stage(std::string_view name, std::string_view unit, std::uint64_t total) = 0;

    /// The stage, as is known better by now, takes `total` units in all.
    virtual void expect(std::uint64_t /*total*/) {}

    /// `count` more units of the stage are done. Throws gnomon::Interrupted if the user asked to stop.
    virtual void advance(std::uint64_t count) = 0;

    /// So many bytes of temporary files are in use now.
    virtual void temporarySpace(std::uint64_t /*bytes*/) {}
};

/// Thrown out of `Progress::advance` after Ctrl-C, so that work unwinds and leaves nothing half-written.
struct Interrupted {};

/// The progress that nobody watches.
class NoProgress final : public Progress {
public:
    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override {}
};

} // namespace gnomon
