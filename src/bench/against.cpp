#include "bench/against.h"

#include <algorithm>

namespace gnomon::bench {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

} // namespace

std::vector<std::string> withoutOptions(const std::vector<std::string>& words, const RemovedOptions& removed) {
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        const std::string name = words[i].substr(0, equals);
        const bool hasOwnValue = equals != std::string::npos;
        if (contains(removed.flags, name)) continue;
        if (contains(removed.withValue, name)) {
            i += hasOwnValue ? 0 : 1;
            continue;
        }
        if (contains(removed.withOptionalValue, name)) {
            const bool hasValue =
                !hasOwnValue && i + 1 < words.size() && contains(removed.optionalValues, words[i + 1]);
            i += hasValue ? 1 : 0;
            continue;
        }
        kept.push_back(words[i]);
    }
    return kept;
}

BothSides measureAlternately(
    const Side& before, const Side& after, int repetitions, const MeasureOnce& measure, Progress& progress) {
    BothSides sides;
    const auto add = [&](const Side& side, ResultSet& all, bool isFirst) {
        ResultSet once = measure(side, isFirst);
        progress.advance(1);
        if (isFirst)
            all = std::move(once);
        else
            append(all, once);
    };
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        const bool isFirst = repetition == 0;
        if (repetition % 2 == 0) add(before, sides.before, isFirst);
        add(after, sides.after, isFirst);
        if (repetition % 2 == 1) add(before, sides.before, isFirst);
    }
    return sides;
}

} // namespace gnomon::bench
