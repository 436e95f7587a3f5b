// A guess of the up direction, from the model's place on the earth and from its shape. Used if neither the user nor the
// source specifies it.
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

/// The confidence in the up direction: Told by the user or the source; Sure, a guess that is almost never wrong; or
/// Guess, any other guess.
enum class UpConfidence : std::uint8_t { Told, Sure, Guess };
inline constexpr std::array kUpConfidences = {
    Word<UpConfidence>{UpConfidence::Told, "told"},
    Word<UpConfidence>{UpConfidence::Sure, "sure"},
    Word<UpConfidence>{UpConfidence::Guess, "guess"},
};

/// A direction, and the reason for its choice as a text that follows the axis: "by its shape".
struct UpGuess {
    UpAxis up;
    std::string because;
    UpConfidence confidence = UpConfidence::Guess;
};

/// Votes of the source's file type for the directions +x, -x, +y, -y, +z, -z, in the same unit as the votes of the
/// shape. A lead of kSureVotes makes a guess sure.
using UpVotes = std::array<int, 6>;
constexpr int kSureVotes = 2500;

/// Returns the up direction of survey coordinates within `box` of the world, or nullopt for other coordinates. Planar
/// coordinates such as UTM have two coordinates that are large and much larger than the box. Their up axis is the third
/// one. Earth-centred coordinates lie within 10 km of the WGS84 ellipsoid. Their up direction is the normal of the
/// ellipsoid.
std::optional<UpGuess> upOfPlace(const Box& box);

/// The collected evidence about the up direction from a cut of a model. The same pages give the same guess on all
/// platforms, because the computation uses no library function with platform-dependent rounding.
class UpSurvey {
public:
    /// Makes a survey of the geometry within `part` of the world.
    UpSurvey(const Grid& grid, const Box& part);

    /// Adds the clusters of a page that a uniform cut of `error` draws.
    void add(const Page& page, double error);

    /// Returns the direction that follows from the place, otherwise the direction with the most votes of the shape and
    /// of `votes`. The votes of the shape are a sum over decision trees (up_trees.h), which were fitted to meshes with
    /// known axes. If the lead of the direction is less than kSureVotes, only y and z are candidates.
    UpGuess guess(const UpVotes& votes = {}) const;

    const std::vector<std::array<glm::vec3, 3>>& triangles() const { return triangles_; }

private:
    Box part_;
    glm::dvec3 origin_; // origin of the grid, relative to the centre of the part
    double step_;
    std::vector<std::array<glm::vec3, 3>> triangles_; // relative to the centre of the part
};

} // namespace gnomon::hierarchy
