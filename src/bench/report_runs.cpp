#include "bench/report_runs.h"

#include "settings/table.h"
#include "task/session.h"

#include <algorithm>
#include <initializer_list>

namespace gnomon::bench {

namespace {

using plan::Choice;
using plan::Quality;
using settings::Settings;
using shadow::WarpRule;

/// Returns `base` with exact shadows. All settings of shadow maps get their default, because they would contradict
/// exact shadows.
Settings withExactShadows(const Settings& base) {
    Settings result = base;
    for (const settings::Setting& setting : settings::table())
        if (setting.description().isOfMaps) setting.set(result, setting.value(Settings()));
    result.isWarpGiven = false;
    result.quality.shadows = plan::ShadowMode::Exact;
    return result;
}

/// A list of different settings, in the order in which they were added.
class DistinctSettings {
public:
    /// Adds `settings` if the list does not contain equal settings.
    void add(const Settings& settings) {
        const auto isAlike = [&](const Settings& other) {
            return settings::areAlike(settings, other) && settings.quality.cellScheme == other.quality.cellScheme;
        };
        if (std::none_of(all_.begin(), all_.end(), isAlike)) all_.push_back(settings);
    }

    /// Adds a copy of `base` per value in `values`, with this value in `member`.
    template <class Member, class T>
    void vary(const Settings& base, Member Quality::*member, std::initializer_list<T> values) {
        for (const T& value : values) {
            Settings settings = base;
            settings.quality.*member = value;
            add(settings);
        }
    }

    /// Adds `base` with exact shadows, once per cell scheme.
    void addExact(const Settings& base) {
        for (const auto& scheme : plan::kCellSchemes) {
            Settings settings = withExactShadows(base);
            settings.quality.cellScheme = scheme.value;
            add(settings);
        }
    }

    const std::vector<Settings>& all() const { return all_; }

private:
    std::vector<Settings> all_;
};

Settings withWarp(Settings settings, WarpRule rule) {
    settings.quality.warp.rule = rule;
    return settings;
}

Settings withTexels(Settings settings, int side) {
    settings.quality.shadowTexelsWidth = settings.quality.shadowTexelsHeight = side;
    return settings;
}

/// Adds a single logarithmic map and logarithmic maps of the faces. If not `isQuick`, adds both with fewer and with
/// more texels too, so that the report shows their curve of error and time.
void addLogarithmic(DistinctSettings& runs, const Settings& oneMap, bool isQuick) {
    const Settings whole = withWarp(oneMap, WarpRule::Log);
    Settings faces = whole;
    faces.quality.facePartitions = Choice::On;
    runs.add(whole);
    runs.add(faces);
    if (isQuick) return;
    for (const int side : {1024, 4096}) {
        runs.add(withTexels(whole, side));
        runs.add(withTexels(faces, side));
    }
}

} // namespace

std::vector<BenchRun> reportRuns(const Settings& asked, bool isQuick) {
    Settings base = asked; // with shadow maps, because exact shadows have separate runs
    if (base.quality.shadows == plan::ShadowMode::Auto) base.quality.shadows = plan::ShadowMode::Maps;
    base.quality.mapsBecause.reset();
    const bool isExactToo =
        settings::capabilitiesOf(task::backendFor(base, settings::DrawingCommand::Bench).backend).exactShadows;
    const bool isWarpOpen = !base.eta && !base.tsmFocus;
    Settings unculled = base;
    unculled.quality.cullCasters = plan::CasterCulling::Off;
    Settings oneMap = base;
    oneMap.quality.zPartitions = 1;
    Settings stable = withWarp(base, WarpRule::None); // stabilised maps have no warp
    stable.quality.stabilize = true;
    DistinctSettings runs;
    if (isQuick) {
        runs.vary(base, &Quality::zPartitions, {1, 2, 4, 8});
        runs.vary(base, &Quality::errorPixels, {2.0, 4.0});
        runs.add(unculled);
        if (isWarpOpen) {
            runs.add(withWarp(base, WarpRule::None));
            runs.add(withWarp(oneMap, WarpRule::None));
        }
        if (isExactToo) {
            if (isWarpOpen) addLogarithmic(runs, oneMap, isQuick);
            runs.addExact(base);
        }
        return runsOf(runs.all());
    }
    runs.vary(base, &Quality::zPartitions, {1, 2, 3, 4, 6, 8});
    runs.vary(unculled, &Quality::zPartitions, {1, 2, 4, 8});
    runs.vary(base, &Quality::errorPixels, {0.5, 1.0, 2.0, 4.0, 8.0});
    if (isWarpOpen) {
        for (const WarpRule rule : {WarpRule::None, WarpRule::Lspsm, WarpRule::Psm, WarpRule::Tsm, WarpRule::Minimax})
            runs.add(withWarp(oneMap, rule));
        runs.add(withWarp(base, WarpRule::None));
    }
    runs.add(withTexels(base, 1024));
    runs.add(withTexels(base, 4096));
    if (isWarpOpen) runs.add(stable);
    runs.vary(base, &Quality::facePartitions, {Choice::On});
    if (isExactToo) {
        if (isWarpOpen) addLogarithmic(runs, oneMap, isQuick);
        runs.addExact(base);
    }
    return runsOf(runs.all());
}

} // namespace gnomon::bench
