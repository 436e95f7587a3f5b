// The measures that the user takes in the window, point by point.
#pragma once

#include "inspect/measures.h"

#include <string>
#include <vector>

namespace gnomon::viewer {

/// The measures of one model. All measures except the last are complete. The last one receives the points of new
/// clicks.
class Measuring {
public:
    Measuring() = default;

    explicit Measuring(inspect::Surveyed of) : of_(std::move(of)) {}

    /// Returns true if clicks add points and the measures are visible.
    bool isOn() const { return isOn_; }

    void toggle() { isOn_ = !isOn_; }

    void take(const inspect::Point& point) { measures_.back().push_back(point); }

    /// Removes the last point. Returns false if there is none.
    bool dropLast();

    /// Starts a new measure. Returns false if the last measure has no points.
    bool beginNext();

    bool isEmpty() const { return measures_.front().empty(); }

    /// Returns at least one measure. The last one may be empty.
    const std::vector<inspect::Measure>& measures() const { return measures_; }

    const inspect::Surveyed& of() const { return of_; }

    /// Returns the result of the last measure with points, and the available keys.
    std::vector<std::string> inWords() const;

    /// Return all measures with points as the text of a JSON or CSV file.
    std::string json() const;
    std::string csv() const;

private:
    std::vector<inspect::Measure> withPoints() const;

    inspect::Surveyed of_;
    std::vector<inspect::Measure> measures_{1};
    bool isOn_ = false;
};

} // namespace gnomon::viewer
