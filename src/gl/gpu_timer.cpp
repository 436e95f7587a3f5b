#include "gl/gpu_timer.h"

#include <algorithm>

namespace gnomon::gl {

GpuTimer::GpuTimer(const Api& api) : api_(&api) {
    const auto query = [&] {
        GLuint name = 0;
        api.createQueries(GL_TIMESTAMP, 1, &name);
        return Object(name, api.deleteQueries);
    };
    for (Pair& pair : pairs_)
        pair = {query(), query()};
}

void GpuTimer::begin() {
    api_->queryCounter(pairs_[passes_ % kPasses].first.id(), GL_TIMESTAMP);
}

void GpuTimer::end() {
    api_->queryCounter(pairs_[passes_ % kPasses].second.id(), GL_TIMESTAMP);
    ++passes_;
}

Milliseconds GpuTimer::read(std::size_t pass) const {
    const Pair& pair = pairs_[pass % kPasses];
    GLuint64 first = 0;
    GLuint64 second = 0;
    api_->getQueryObjectui64v(pair.first.id(), GL_QUERY_RESULT, &first);
    api_->getQueryObjectui64v(pair.second.id(), GL_QUERY_RESULT, &second);
    constexpr double kNanosecondsAMillisecond = 1e6;
    return {static_cast<double>(second - std::min(first, second)) / kNanosecondsAMillisecond};
}

Milliseconds GpuTimer::finished() {
    if (passes_ > 0) latest_ = read(passes_ - 1);
    return latest_;
}

Milliseconds GpuTimer::latest() {
    const std::size_t kept = std::min(passes_, kPasses);
    for (std::size_t back = 1; back <= kept; ++back) {
        GLint isKnown = GL_FALSE;
        api_->getQueryObjectiv(pairs_[(passes_ - back) % kPasses].second.id(), GL_QUERY_RESULT_AVAILABLE, &isKnown);
        if (isKnown == GL_FALSE) continue;
        latest_ = read(passes_ - back);
        break;
    }
    return latest_;
}

} // namespace gnomon::gl
