// Stores the measurements that the user takes in the window by clicking points.
#pragma once

#include "inspect/measures.h"

#include <string>
#include <vector>

namespace gnomon::viewer {

/// The measurements of one model in the window. All except the last one are complete. New clicks add points to the last
/// one.
class Measuring {
public:
    Measuring() = default;

    explicit Measuring(inspect::Surveyed of) : of_(std::move(of)) {}

    /// Returns true if clicks add points to a measurement and the measurements are visible.
    bool isOn() const { return isOn_; }

    void toggle() { isOn_ = !isOn_; }

    void take(const inspect::Point& point) { measures_.back().push_back(point); }

    /// Removes the last clicked point of the measurements. Returns false if there is none.
    bool dropLast();

    /// Starts a new measurement. Returns false if the last one has no points.
    bool beginNext();

    bool isEmpty() const { return measures_.front().empty(); }

    /// Returns the measurements, at least one. The last one may have no points.
    const std::vector<inspect::Measure>& measures() const { return measures_; }

    const inspect::Surveyed& of() const { return of_; }

    /// Returns lines with the result of the last measurement that has points, and with the available keys.
    std::vector<std::string> inWords() const;

    /// Return the measurements that have points as the text of a JSON or CSV file.
    std::string json() const;
    std::string csv() const;

private:
    std::vector<inspect::Measure> withPoints() const;

    inspect::Surveyed of_;
    std::vector<inspect::Measure> measures_{1};
    bool isOn_ = false;
};

} // namespace gnomon::viewer
