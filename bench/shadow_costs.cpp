// What exact shadows and maps of seeded views take, beside what was predicted of them: a row of CSV each, from which
// bench/fit_shadow_choice fits the constants of plan/shadow_choice.cpp.
#include "executor/software_executor.h"
#include "frame/renderer.h"
#include "frame/shadow_triples.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {
namespace {

/// Milliseconds of the processor or by the clock: the first, on one thread, mean something on a busy machine too.
class Clock {
public:
    explicit Clock(bool isOfProcessor) : isOfProcessor_(isOfProcessor) {}

    double now() const {
        using Milliseconds = std::chrono::duration<double, std::milli>;
        if (!isOfProcessor_) return Milliseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
        return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    }

private:
    bool isOfProcessor_;
};

struct Timed {
    double ms = 0;        // the median of a frame
    double predictMs = 0; // of what only `auto` adds to it
    frame::Frame frame;
};

class Bench {
public:
    Bench(const std::string& model, const Clock& clock, int width, int height, int repetitions)
        : name_(model),
          model_(model, Bytes{1ULL << 30U}),
          clock_(clock),
          width_(width),
          height_(height),
          repetitions_(repetitions),
          renderer_(model_, *executor_, {}) {}

    void measure(std::uint64_t index) {
        tests::ShadowTriple triple = tests::shadowTriple(model_.summary().bounds, index, width_, 256);
        triple.view.height = height_;
        std::vector<double> maps, exact;
        frame::Frame ofMaps, ofExact;
        for (int i = 0; i <= repetitions_; ++i) { // turn about; the first round loads pages
            const double begin = clock_.now();
            ofMaps = draw(triple.view, plan::ShadowMode::Maps);
            const double between = clock_.now();
            ofExact = draw(triple.view, plan::ShadowMode::Exact);
            const double end = clock_.now();
            if (i == 0) continue;
            maps.push_back(between - begin);
            exact.push_back(end - between);
        }
        print(index, ofMaps, ofExact, median(maps), median(exact));
    }

private:
    frame::Frame draw(const plan::View& view, plan::ShadowMode mode) {
        plan::Quality quality;
        quality.shadows = mode;
        renderer_.forget();
        return renderer_.render(view, quality, {});
    }

    static double median(std::vector<double>& values) {
        std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
        return values[values.size() / 2];
    }

    void print(
        std::uint64_t index, const frame::Frame& maps, const frame::Frame& exact, double mapsMs, double exactMs) const {
        if (!exact.plan.predicted || exact.row.shadowSamples.value_or(0) == 0) return; // nothing to choose
        const plan::ExactWork& work = *exact.plan.predicted;
        const plan::ShadowCosts costs = plan::shadowCosts(work);
        std::printf(
            "%s,%llu,%d,%.0f,%.0f,%.0f,%.0f,%.0f,%.0f,%lld,%lld,%lld,%lld,%lld,%.0f,%.0f,%.3f,%.3f,%lld,%lld\n",
            name_.c_str(),
            static_cast<unsigned long long>(index),
            width_ * height_,
            work.samples,
            work.casterTriangles,
            work.keptTriangles,
            work.castTriangles,
            work.sampleTests,
            work.mapFragments,
            static_cast<long long>(exact.row.shadowSamples.value_or(0)),
            static_cast<long long>(exact.row.shadowTriangles.value_or(0)),
            static_cast<long long>(exact.row.sampleTests.value_or(0)),
            static_cast<long long>(maps.row.shadowTriangles.value_or(0)),
            static_cast<long long>(maps.row.shadowFragments.value_or(0)),
            costs.exact,
            costs.maps,
            mapsMs,
            exactMs,
            static_cast<long long>(exact.row.refinedCastTriangles.value_or(0)),
            static_cast<long long>(exact.row.refinedSampleTests.value_or(0)));
        std::fflush(stdout);
    }

    std::string name_;
    hierarchy::ModelFile model_;
    Clock clock_;
    int width_;
    int height_;
    int repetitions_;
    std::unique_ptr<executor::Executor> executor_ = executor::makeSoftwareExecutor();
    frame::Renderer renderer_;
};

int run(int count, char** arguments) {
    const std::string clock = count > 1 ? arguments[1] : "";
    if (count < 7 || (clock != "work" && clock != "time")) {
        std::fprintf(stderr, "usage: %s work|time FIRST VIEWS WxH REPETITIONS MODEL.gnm...\n", arguments[0]);
        return 2;
    }
    const bool isOfProcessor = clock == "work";
    std::optional<tbb::global_control> oneThread;
    if (isOfProcessor) oneThread.emplace(tbb::global_control::max_allowed_parallelism, 1);
    const auto first = static_cast<std::uint64_t>(std::atoll(arguments[2]));
    const auto views = static_cast<std::uint64_t>(std::atoll(arguments[3]));
    const std::string size = arguments[4];
    const int width = std::atoi(size.c_str());
    const int height = std::atoi(size.substr(size.find('x') + 1).c_str());
    std::printf("model,view,pixels,samples,caster_triangles,kept_triangles,cast_triangles,sample_tests,map_fragments,"
                "counted_samples,counted_cast,counted_tests,counted_map_triangles,counted_fragments,cost_exact,"
                "cost_maps,maps_ms,exact_ms,refined_cast,refined_tests\n");
    for (int i = 6; i < count; ++i) {
        Bench bench(arguments[i], Clock(isOfProcessor), width, height, std::max(1, std::atoi(arguments[5])));
        for (std::uint64_t view = first; view < first + views; ++view)
            bench.measure(view);
    }
    return 0;
}

} // namespace
} // namespace gnomon

int main(int count, char** arguments) {
    try {
        return gnomon::run(count, arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shadow_costs: %s\n", error.what());
        return 1;
    }
}
