#include "bench/alike_keys.h"

#include "settings/removed_words.h"
#include "settings/table.h"

#include <algorithm>
#include <sstream>

namespace gnomon::bench {

std::vector<std::string> alikeKeys(
    const ResultSet& before, const std::map<std::string, std::string>& now, bool allowsOtherModel) {
    std::vector<std::string> keys{"path_content_hash", "frames", "real_time", "backend", "threads"};
    keys.emplace_back(
        !allowsOtherModel     ? "model_content_hash"
        : before.hasOnlyTimes ? "model_triangles"
                              : "model_source");
    for (const settings::Setting& setting : settings::table()) {
        const std::string& stated = setting.description().statedAs;
        if (!stated.empty() && std::find(keys.begin(), keys.end(), stated) == keys.end()) {
            // An earlier file lacks settings that did not exist then; they have their default now.
            const auto value = now.find(stated);
            const bool isUnset = value != now.end() && value->second == "not given";
            if (before.context.contains(stated) || !isUnset) keys.push_back(stated);
        }
        const bool isSwept = before.hasOnlyTimes && setting.description().isSwept;
        if (isSwept && before.context.contains(setting.column()) && now.contains(setting.column()))
            keys.push_back(setting.column());
    }
    if (!before.hasOnlyTimes) keys.insert(keys.end(), {"options", "picture"});
    return keys;
}

void refuseRemovedWords(const ResultSet& set) {
    for (const settings::Setting& setting : settings::table()) {
        if (const auto stated = set.context.find(setting.column()); stated != set.context.end())
            settings::refuseRemovedWord(setting.option(), stated->second);
        const std::string key = setting.column() + ":";
        for (const RunRecord& run : set.runs) {
            std::istringstream parts(run.label);
            for (std::string part; std::getline(parts, part, '/');)
                if (part.starts_with(key)) settings::refuseRemovedWord(setting.option(), part.substr(key.size()));
        }
    }
}

} // namespace gnomon::bench
