// Which way is up where nobody says so: a guess from a model's place on the earth and from its shape.
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

/// How well it is known which way is up: the user or the source says so; a guess that is nearly never wrong; any guess.
enum class UpConfidence : std::uint8_t { Told, Sure, Guess };
inline constexpr std::array kUpConfidences = {
    Word<UpConfidence>{UpConfidence::Told, "told"},
    Word<UpConfidence>{UpConfidence::Sure, "sure"},
    Word<UpConfidence>{UpConfidence::Guess, "guess"},
};

/// A direction and why it was chosen, in words that follow the axis: "by its shape".
struct UpGuess {
    UpAxis up;
    std::string because;
    UpConfidence confidence = UpConfidence::Guess;
};

/// What the kind of a source says for the directions +x, -x, +y, -y, +z, -z, in votes as the shape has them. A lead of
/// kSureVotes makes a guess sure.
using UpVotes = std::array<int, 6>;
constexpr int kSureVotes = 2500;

/// Returns the direction away from the earth of coordinates like those of a survey within `box` of the world: the axis
/// of the small coordinate if the two others are large and far larger than the box, as UTM's are, or the vertical of
/// the WGS84 ellipsoid if the box lies within 10 km of it (earth-centred coordinates). Nothing of other coordinates.
std::optional<UpGuess> upOfPlace(const Box& box);

/// What a cut of a model says of its axes. The same pages give the same guess everywhere: no function of a library is
/// used that rounds otherwise elsewhere.
class UpSurvey {
public:
    /// Of what lies within `part` of the world.
    UpSurvey(const Grid& grid, const Box& part);

    /// Adds what a uniform cut of `error` draws of a page.
    void add(const Page& page, double error);

    /// Returns what the place says, else the direction with the most votes of the shape and of `votes`. The shape's
    /// votes are a sum over decision trees (up_trees.h), which were fitted to meshes of known axes. If the direction
    /// leads by less than kSureVotes, only y and z are considered.
    UpGuess guess(const UpVotes& votes = {}) const;

    const std::vector<std::array<glm::vec3, 3>>& triangles() const { return triangles_; }

private:
    Box part_;
    glm::dvec3 origin_; // of the grid, from the middle of the part
    double step_;
    std::vector<std::array<glm::vec3, 3>> triangles_; // from the middle of the part
};

} // namespace gnomon::hierarchy
