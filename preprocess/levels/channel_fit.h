// What the vertices of a simplified patch carry in up to four channels, fitted to those of the patch that it replaces.
#pragma once

#include "hierarchy/page_fields.h"
#include "preprocess/levels/simplified_surface.h"

#include <algorithm>
#include <cmath>

namespace gnomon::levels {

/// A vertex, by its number in a patch or a mesh, and the word that it takes: a colour, or its fields.
struct TransferredWord {
    std::uint32_t vertex = 0;
    std::uint32_t word = 0;
};

/// One step of a least squares fit, over the area of a patch, of what is interpolated between the vertices that are
/// left to what was there; so a pattern that is gone leaves its mean, and one that is kept stays sharp. Vertices at
/// locked positions keep what they have. For one patch at a time; what it is made of must outlive it.
class ChannelFit {
public:
    using Channels = std::array<float, hierarchy::kMostFields>;

    /// `words` are those of the patch's vertices, and channels lie in them as `layout` says.
    ChannelFit(
        const simplify::Patch& patch,
        const simplify::SimplifiedPatch& simplified,
        std::vector<std::uint32_t> words,
        const hierarchy::FieldLayout& layout);

    /// The words of the vertices that are left and that change, ascending.
    std::vector<TransferredWord> run();

    /// After `run`: calls `take(length, difference)` for points of all triangles of the patch where not all is of one
    /// word, each compared with the nearest simplified triangle around what its corners were collapsed into. `length`
    /// is how far these moved, grid steps; `difference` the largest of a channel, as a part of the first one's range.
    template <class Take>
    void forEachDifference(const Take& take) const {
        for (const Sample& sample : samples_) {
            const Channels there = found(sample);
            float largest = 0;
            for (std::size_t i = 0; i < there.size(); ++i)
                largest = std::max(largest, std::abs(sample.channels[i] - there[i]));
            take(sample.length, static_cast<double>(largest) / layout_.greatest(0));
        }
    }

private:
    using Weights = std::array<float, 3>;

    /// A point of the patch, and where it lies on the simplified one.
    struct Sample {
        Channels channels{};
        Weights weights{};
        std::uint32_t triangle = hierarchy::kNone;
        double length = 0;
    };

    Channels channelsOf(std::uint32_t word) const;
    std::uint32_t packed(const Channels& channels) const;
    Channels mixed(const simplify::Triangle& t, const Weights& weights) const;

    Channels found(const Sample& sample) const { return mixed(simplified_.triangles[sample.triangle], sample.weights); }

    /// What the simplified triangles around a position have at their corners.
    enum class Around : std::uint8_t { NoTriangle, OneWord, Words };

    void compareWordsAround();
    bool isPlain(const simplify::Triangle& t) const;
    void gatherCandidates(const simplify::Triangle& t);
    double lengthOf(const simplify::Triangle& t) const;
    void compare(std::uint32_t number);

    const simplify::Patch& patch_;
    const simplify::SimplifiedPatch& simplified_;
    hierarchy::FieldLayout layout_;
    SimplifiedSurface surface_;
    std::vector<std::uint32_t> words_;
    std::vector<Around> around_;            // per position that is left
    std::vector<std::uint32_t> wordAround_; // likewise, of those with OneWord
    std::vector<double> reach_;             // per position: how far what was collapsed into it moved
    std::vector<Channels> channels_;        // per vertex
    std::vector<Channels> residual_;
    std::vector<float> weight_;      // of what the residuals were added up over
    std::vector<float> plainWeight_; // per position: likewise, of triangles without any
    std::vector<Sample> samples_;
    std::vector<std::uint32_t> candidates_;
};

} // namespace gnomon::levels
