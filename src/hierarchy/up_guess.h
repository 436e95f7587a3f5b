// Which way is up where nobody says so: what stands on the ground, lies as land does, or has floors.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/world_frame.h"

#include <array>
#include <string>

namespace gnomon::hierarchy {

struct Grid;

/// A direction and why it was taken, in words that end a sentence: "it stands on 67% of its outline".
struct UpGuess {
    UpAxis up;
    std::string because;
    bool isSure = false; // else nothing speaks clearly for any axis, and up is y
};

/// What a cut of a model says of its axes. Sums are taken in the order of `add`, with no function of a library that
/// rounds otherwise elsewhere: the same pages give the same guess everywhere.
class UpSurvey {
public:
    /// Of a model within `bounds`, world space.
    UpSurvey(const Grid& grid, const Box& bounds);

    /// Takes what a uniform cut of `error` draws of a page.
    void add(const Page& page, double error);

    /// The first of these that holds, and y if none does; nothing is guessed for a model that may as well be upright.
    /// 1. It is land: 90% of an open surface faces z, it is flat, and more than 1,000 wide or far from the origin.
    /// 2. It stands: of the vertices within 2% of the lowest the convex outline has at least 40% of the area of the
    ///    whole outline seen along the axis (30% for y), the middle of the surface is well within it and no higher than
    ///    45% (60% for y); and it stands on no other side; what is built has its
    ///    floors there. y first. (Static stability, as in Fu et al. 2008.)
    /// 3. It has floors: 30% of its area is level if z is up, and 1.4 times what would be if x or y were.
    UpGuess guess() const;

private:
    static constexpr int kBearings = 32;

    /// The furthest points of a set in each of some directions of a plane: the corners of its convex outline.
    struct Outline {
        std::array<glm::dvec2, kBearings> corners{};
        bool isEmpty = true;

        void add(const glm::dvec2& point);
        double area() const;
        double depthOf(const glm::dvec2& point) const; // how far within it is; below 0 outside
    };

    /// What is seen along one axis.
    struct Axis {
        Outline whole;
        std::array<Outline, 2> base; // of what is lowest if the axis is up, and if it is down
        double levelArea = 0;
    };

    struct Footing {
        double share = 0;  // of the whole outline
        double within = 0; // how well the middle is above it, 1 at most
        double height = 0; // of the middle, as a share
    };

    void addVertex(const glm::dvec3& position);
    Footing footing(int axis, bool isDown) const;
    bool stands(int axis, bool isDown) const;
    bool isLand() const;
    bool hasFloors() const;

    double share(int axis) const { return area_ > 0 ? axes_[static_cast<std::size_t>(axis)].levelArea / area_ : 0; }

    glm::dvec3 extent_;
    glm::dvec3 least_; // local space
    double step_;
    double distance_; // of the world's origin
    double area_ = 0;
    glm::dvec3 moment_{0};
    glm::dvec3 facing_{0}; // the sum of all areas as vectors
    std::array<Axis, 3> axes_;
};

} // namespace gnomon::hierarchy
