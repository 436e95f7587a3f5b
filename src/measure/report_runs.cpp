#include "measure/report_runs.h"

#include <algorithm>

namespace gnomon::measure {

namespace {

using Setting = std::string settings::SweptSettings::*;

/// Settings in the order in which they were first asked for.
class DistinctSettings {
public:
    void add(const settings::SweptSettings& settings) {
        if (std::find(all_.begin(), all_.end(), settings) == all_.end()) all_.push_back(settings);
    }

    /// `base` with `setting` at each of `values`.
    void vary(const settings::SweptSettings& base, Setting setting, std::initializer_list<const char*> values) {
        for (const char* value : values) {
            settings::SweptSettings settings = base;
            settings.*setting = value;
            add(settings);
        }
    }

    const std::vector<settings::SweptSettings>& all() const { return all_; }

private:
    std::vector<settings::SweptSettings> all_;
};

} // namespace

std::vector<BenchRun> reportRuns(const settings::SweptSettings& base, bool isQuick, bool isWarpOpen) {
    settings::SweptSettings unculled = base;
    unculled.cullCasters = "off";
    settings::SweptSettings unwarped = base;
    unwarped.warp = "none";
    settings::SweptSettings oneMap = base;
    oneMap.zPartitions = "1";
    settings::SweptSettings stable = base;
    stable.stabilize = "on";
    stable.warp = "none"; // it has none, and a warp that is asked for contradicts it
    DistinctSettings runs;
    if (isQuick) {
        runs.vary(base, &settings::SweptSettings::zPartitions, {"1", "2", "4", "8"});
        runs.vary(base, &settings::SweptSettings::errorPixels, {"2", "4"});
        runs.add(unculled);
        if (isWarpOpen) runs.add(unwarped);
        return named(runs.all());
    }
    runs.vary(base, &settings::SweptSettings::zPartitions, {"1", "2", "3", "4", "6", "8"});
    runs.vary(unculled, &settings::SweptSettings::zPartitions, {"1", "2", "4", "8"});
    runs.vary(base, &settings::SweptSettings::errorPixels, {"0.5", "1", "2", "4", "8"});
    if (isWarpOpen) {
        runs.vary(oneMap, &settings::SweptSettings::warp, {"none", "lspsm", "psm", "tsm", "minimax"});
        runs.add(unwarped);
    }
    runs.vary(base, &settings::SweptSettings::shadowTexels, {"1024x1024", "4096x4096"});
    if (isWarpOpen) runs.add(stable);
    runs.vary(base, &settings::SweptSettings::facePartitions, {"on"});
    return named(runs.all());
}

} // namespace gnomon::measure
