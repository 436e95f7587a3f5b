#include "api/watched.h"

#include "core/error.h"

namespace gnomon::api {

void Watched::stage(std::string_view name, std::string_view /*unit*/, std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    stage_ = name;
    done_ = 0;
    total_ = total;
    told();
}

void Watched::expect(std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    total_ = total;
}

void Watched::advance(std::uint64_t count) {
    const std::lock_guard lock(mutex_);
    done_ += count;
    told();
}

void Watched::told() {
    if (tell_ && !tell_(stage_, done_, total_)) throw Error(stage_, "cancelled by the caller");
}

} // namespace gnomon::api
