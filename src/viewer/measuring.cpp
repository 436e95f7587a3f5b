#include "viewer/measuring.h"

namespace gnomon::viewer {

bool Measuring::dropLast() {
    if (measures_.back().empty() && measures_.size() > 1) measures_.pop_back();
    if (measures_.back().empty()) return false;
    measures_.back().pop_back();
    return true;
}

bool Measuring::beginNext() {
    if (measures_.back().empty()) return false;
    measures_.emplace_back();
    return true;
}

std::vector<inspect::Measure> Measuring::withPoints() const {
    std::vector<inspect::Measure> all = measures_;
    if (all.back().empty()) all.pop_back();
    return all;
}

std::vector<std::string> Measuring::inWords() const {
    const std::vector<inspect::Measure> all = withPoints();
    std::vector<std::string> lines;
    if (!all.empty()) lines = inspect::inWords(all.back(), of_);
    if (all.size() > 1) lines.insert(lines.begin(), "measure " + std::to_string(all.size()));
    lines.emplace_back("click a point, Shift+click a vertex; Backspace drops it, Enter begins another, Shift+U saves");
    return lines;
}

std::string Measuring::json() const {
    return inspect::jsonOf(withPoints(), of_);
}

std::string Measuring::csv() const {
    return inspect::csvOf(withPoints(), of_);
}

} // namespace gnomon::viewer
