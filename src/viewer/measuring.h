// The measures of a model that are taken in its window, point by point.
#pragma once

#include "survey/measures.h"

#include <string>
#include <vector>

namespace gnomon::viewer {

/// What is measured of one model. All but the last measure are done; the last takes the points to come.
class Measuring {
public:
    Measuring() = default;

    explicit Measuring(survey::Surveyed of) : of_(std::move(of)) {}

    /// Whether clicks take points, and what was measured is shown.
    bool isOn() const { return isOn_; }

    void toggle() { isOn_ = !isOn_; }

    void take(const survey::Point& point) { measures_.back().push_back(point); }

    /// Drops the last point that was taken; false if there is none.
    bool dropLast();

    /// The points to come are those of another measure; false if the last one has none yet.
    bool beginNext();

    bool isEmpty() const { return measures_.front().empty(); }

    /// At least one; the last may be empty.
    const std::vector<survey::Measure>& measures() const { return measures_; }

    const survey::Surveyed& of() const { return of_; }

    /// What the last measure with points comes to, and what can be done.
    std::vector<std::string> inWords() const;

    /// All measures with points, as files hold them.
    std::string json() const;
    std::string csv() const;

private:
    std::vector<survey::Measure> withPoints() const;

    survey::Surveyed of_;
    std::vector<survey::Measure> measures_{1};
    bool isOn_ = false;
};

} // namespace gnomon::viewer
