// Fits the vertex attributes of a simplified patch to the attributes of the original patch. It fits up to four
// channels.
#pragma once

#include "hierarchy/page_fields.h"
#include "preprocess/levels/simplified_surface.h"

#include <algorithm>
#include <cmath>

namespace gnomon::levels {

/// A vertex index and the new attributes of this vertex. The attributes are one word: a packed colour or packed fields.
struct TransferredWord {
    std::uint32_t vertex = 0;
    std::uint32_t word = 0;
};

/// Fits the vertex attributes of a simplified patch to the original patch. It makes one step of a least-squares fit of
/// the interpolated attributes over the area of the patch. If the simplification removes a pattern, the mean of the
/// pattern remains. A pattern that the simplification preserves stays sharp. Vertices at locked positions do not
/// change. One object fits one patch. The constructor's inputs must outlive it.
class ChannelFit {
public:
    using Channels = std::array<float, hierarchy::kMaxFields>;

    /// Prepares the fit. `words` contains the packed attributes of each vertex of `patch`. `layout` describes the
    /// channels of a word.
    ChannelFit(
        const simplify::Patch& patch,
        const simplify::SimplifiedPatch& simplified,
        std::vector<std::uint32_t> words,
        const hierarchy::FieldLayout& layout);

    /// Returns the new attributes of all vertices whose attributes change, by ascending vertex.
    std::vector<TransferredWord> run();

    /// Calls `take(length, difference)` for sample points of the original triangles. `run` must be called before. The
    /// function skips triangles without an attribute difference. It compares each sample with the nearest simplified
    /// triangle around the collapsed corners of the sample's triangle. `length` is the distance in grid steps by which
    /// these corners moved. `difference` is the largest difference of a channel, divided by the range of the first
    /// channel.
    template <class Take>
    void forEachDifference(const Take& take) const {
        for (const Sample& sample : samples_) {
            const Channels there = found(sample);
            float largest = 0;
            for (std::size_t i = 0; i < there.size(); ++i)
                largest = std::max(largest, std::abs(sample.channels[i] - there[i]));
            take(sample.length, static_cast<double>(largest) / layout_.maxNumber(0));
        }
    }

private:
    using Weights = std::array<float, 3>;

    /// A sample point of the original patch and its nearest point on the simplified patch.
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

    /// Whether the simplified triangles around a position have equal attribute words at all corners. NoTriangle: there
    /// are no triangles. OneWord: all words are equal. Words: the words differ.
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
    std::vector<Around> around_;            // per position; valid if the position remains
    std::vector<std::uint32_t> wordAround_; // per position: the equal attribute word; valid for OneWord
    std::vector<double> reach_;             // per position: max distance to a position that was collapsed onto it
    std::vector<Channels> channels_;        // attributes of each vertex
    std::vector<Channels> residual_;
    std::vector<float> weight_;      // per vertex: area of the samples in its residual
    std::vector<float> plainWeight_; // per position: area of the triangles with a residual of zero
    std::vector<Sample> samples_;
    std::vector<std::uint32_t> candidates_;
};

} // namespace gnomon::levels
