#include "bench/result_set.h"

#include "telemetry/benchmark_report.h"

#include <algorithm>

namespace gnomon::bench {

void append(ResultSet& all, const ResultSet& more) {
    for (const RunRecord& run : more.runs) {
        const auto place = std::find_if(
            all.runs.begin(), all.runs.end(), [&](const RunRecord& other) { return other.name == run.name; });
        if (place == all.runs.end()) {
            all.runs.push_back(run);
            continue;
        }
        place->realMs.insert(place->realMs.end(), run.realMs.begin(), run.realMs.end());
        place->cpuMs.insert(place->cpuMs.end(), run.cpuMs.begin(), run.cpuMs.end());
        for (const auto& [key, values] : run.process)
            place->process[key].insert(place->process[key].end(), values.begin(), values.end());
        place->errors.insert(run.errors.begin(), run.errors.end());
        place->pagesDamaged = std::max(place->pagesDamaged, run.pagesDamaged);
        place->pagesMissing = std::max(place->pagesMissing, run.pagesMissing);
    }
}

double medianOf(const Times& times) {
    std::vector<double> all;
    for (const std::vector<double>& repetition : times)
        all.insert(all.end(), repetition.begin(), repetition.end());
    return all.empty() ? 0 : telemetry::quantile(all, 0.5);
}

} // namespace gnomon::bench
