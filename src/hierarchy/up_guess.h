// Guesses the up direction of a model from its position on the earth and from its shape. The guess is used if neither
// the user nor the source names the direction.
#pragma once

#include "core/words.h"
#include "hierarchy/page.h"
#include "hierarchy/world_frame.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

struct Grid;

/// Tells how reliable the up direction is. Told: the user or the source named it. Sure: it is a guess that is almost
/// never wrong. Guess: it is any other guess.
enum class UpConfidence : std::uint8_t { Told, Sure, Guess };
inline constexpr std::array kUpConfidences = {
    Word<UpConfidence>{UpConfidence::Told, "told"},
    Word<UpConfidence>{UpConfidence::Sure, "sure"},
    Word<UpConfidence>{UpConfidence::Guess, "guess"},
};

/// A guessed up direction and the reason for it. The reason is a text that can follow the name of the axis, for example
/// "by its shape".
struct UpGuess {
    UpAxis up;
    std::string because;
    UpConfidence confidence = UpConfidence::Guess;
};

/// Votes for the up directions +x, -x, +y, -y, +z, -z that follow from the file type of the source. They have the unit
/// of the votes of the shape. A guess is sure if its lead is at least kSureVotes.
using UpVotes = std::array<int, 6>;
constexpr int kSureVotes = 2500;

/// Returns the up direction if the coordinates of `box` (world space) are survey coordinates, and otherwise nullopt.
/// Planar survey coordinates such as UTM have two coordinates that are large and much larger than the box. The up axis
/// is then the third one. Earth-centred coordinates are within 10 km of the WGS84 ellipsoid. The up direction is then
/// the normal of the ellipsoid.
std::optional<UpGuess> upOfPlace(const Box& box);

/// Collects triangles of a coarse version of a model and guesses the up direction from them. The same pages give the
/// same guess on all platforms, because the computation uses no library function with platform-dependent rounding.
class UpSurvey {
public:
    /// Creates an estimator that uses the geometry inside the box `part` (world space).
    UpSurvey(const Grid& grid, const Box& part);

    /// Adds those clusters of `page` that are drawn when the whole model has the error limit `error`.
    void add(const Page& page, double error);

    /// Returns the guessed up direction. It follows from the position on the earth if possible. Otherwise it is the
    /// direction with the most votes, which are the sum of the votes of the shape and of `votes`. The votes of the
    /// shape are a sum over decision trees (up_trees.h), which were fitted to meshes with known up axes. If the lead of
    /// the direction is less than kSureVotes, only the axes y and z are candidates.
    UpGuess guess(const UpVotes& votes = {}) const;

    const std::vector<std::array<glm::vec3, 3>>& triangles() const { return triangles_; }

private:
    Box part_;
    glm::dvec3 origin_; // origin of the grid, relative to the centre of `part`
    double step_;
    std::vector<std::array<glm::vec3, 3>> triangles_; // corners, relative to the centre of `part`
};

} // namespace gnomon::hierarchy
