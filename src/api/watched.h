// Reports the progress of long tasks to users of the library.
#pragma once

#include "api/gnomon.h"
#include "core/progress.h"

#include <mutex>

namespace gnomon::api {

/// A progress receiver that forwards reports to the user's callback. It throws Error if the callback requests a stop.
class Watched final : public Progress {
public:
    explicit Watched(OnProgress tell) : tell_(std::move(tell)) {}

    void stage(std::string_view name, std::string_view unit, std::uint64_t total) override;
    void expect(std::uint64_t total) override;
    void advance(std::uint64_t count) override;

private:
    void told();

    OnProgress tell_;
    std::mutex mutex_;
    std::string stage_;
    std::uint64_t done_ = 0;
    std::uint64_t total_ = 0;
};

} // namespace gnomon::api
