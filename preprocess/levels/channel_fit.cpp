#include "preprocess/levels/channel_fit.h"

namespace gnomon::levels {

namespace {

/// The barycentric coordinates of the three sample points in a triangle. Each point lies between the centroid and a
/// corner. A sample therefore never lies on an edge at which the attributes change abruptly.
constexpr std::array<std::array<float, 3>, 3> kSampleWeights = {
    {{2.0F / 3, 1.0F / 6, 1.0F / 6}, {1.0F / 6, 2.0F / 3, 1.0F / 6}, {1.0F / 6, 1.0F / 6, 2.0F / 3}}};

/// Returns the width of a triangle, which is its smallest height.
double widthOf(const std::array<glm::dvec3, 3>& t) {
    const double area = glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    const double longest = std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
    return longest > 0 ? area / longest : 0;
}

} // namespace

ChannelFit::ChannelFit(
    const simplify::Patch& patch,
    const simplify::SimplifiedPatch& simplified,
    std::vector<std::uint32_t> words,
    const hierarchy::FieldLayout& layout)
    : patch_(patch),
      simplified_(simplified),
      layout_(layout),
      surface_(patch, simplified),
      words_(std::move(words)),
      around_(patch.positions.size(), Around::NoTriangle),
      wordAround_(patch.positions.size(), 0),
      reach_(patch.positions.size(), 0),
      residual_(patch.vertices.size()),
      weight_(patch.vertices.size(), 0),
      plainWeight_(patch.positions.size(), 0) {
    channels_.reserve(words_.size());
    for (const std::uint32_t word : words_)
        channels_.push_back(channelsOf(word));
    for (std::uint32_t p = 0; p < reach_.size(); ++p) {
        const std::uint32_t q = simplified.movedTo[p];
        const double moved = glm::length(patch.positions[p] - patch.positions[q]);
        reach_[q] = std::max(reach_[q], moved);
    }
    compareWordsAround();
}

std::vector<TransferredWord> ChannelFit::run() {
    for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t)
        compare(t);
    std::vector<TransferredWord> transferred;
    for (std::uint32_t v = 0; v < channels_.size(); ++v) {
        const std::uint32_t p = simplified_.positionOf(patch_, v);
        if (!(weight_[v] > 0) || patch_.isLocked[p] != 0) continue;
        for (std::size_t i = 0; i < channels_[v].size(); ++i)
            channels_[v][i] += residual_[v][i] / (weight_[v] + plainWeight_[p]);
        const std::uint32_t word = packed(channels_[v]);
        channels_[v] = channelsOf(word);
        if (word != words_[v]) transferred.push_back({v, word});
    }
    return transferred;
}

ChannelFit::Channels ChannelFit::channelsOf(std::uint32_t word) const {
    Channels channels{};
    for (std::size_t i = 0; i < channels.size() && layout_.bits[i] > 0; ++i)
        channels[i] = static_cast<float>(layout_.number(word, i));
    return channels;
}

std::uint32_t ChannelFit::packed(const Channels& channels) const {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < channels.size() && layout_.bits[i] > 0; ++i) {
        const float channel = std::clamp(channels[i], 0.0F, static_cast<float>(layout_.maxNumber(i)));
        word |= static_cast<std::uint32_t>(std::lround(channel)) << layout_.shift(i);
    }
    return word;
}

ChannelFit::Channels ChannelFit::mixed(const simplify::Triangle& t, const Weights& weights) const {
    Channels result{};
    for (std::size_t corner = 0; corner < t.size(); ++corner)
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] += channels_[t[corner]][i] * weights[corner];
    return result;
}

void ChannelFit::compareWordsAround() {
    for (const simplify::Triangle& t : simplified_.triangles) {
        const std::uint32_t word = words_[t[0]];
        const bool isOfOneWord = words_[t[1]] == word && words_[t[2]] == word;
        for (const std::uint32_t v : t) {
            const std::uint32_t p = simplified_.positionOf(patch_, v);
            const bool isFirst = around_[p] == Around::NoTriangle;
            const bool isLikeOthers = isFirst || (around_[p] == Around::OneWord && wordAround_[p] == word);
            around_[p] = isOfOneWord && isLikeOthers ? Around::OneWord : Around::Words;
            wordAround_[p] = word;
        }
    }
}

/// Returns true if the simplification does not change the attributes of triangle `t`. All corners of the simplified
/// triangles around the collapsed corners of `t` must have the attribute word of `t`. This is true for most triangles
/// of a surface with few colours. The test does not need the list of candidate triangles.
bool ChannelFit::isPlain(const simplify::Triangle& t) const {
    const std::uint32_t word = words_[t[0]];
    return std::ranges::all_of(t, [&](std::uint32_t v) {
        const std::uint32_t p = simplified_.positionOf(patch_, v);
        const bool isOfWord = around_[p] == Around::OneWord && wordAround_[p] == word;
        return words_[v] == word && (isOfWord || around_[p] == Around::NoTriangle);
    });
}

/// Gathers the simplified triangles around the positions onto which the corners of `t` were collapsed. Each triangle
/// occurs once.
void ChannelFit::gatherCandidates(const simplify::Triangle& t) {
    candidates_.clear();
    for (const std::uint32_t v : t)
        for (const std::uint32_t candidate : surface_.around(patch_.positionOf[v]))
            candidates_.push_back(candidate);
    std::sort(candidates_.begin(), candidates_.end());
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
}

/// Returns the max distance by which a corner of `t` moved. If no corner moved, returns the max distance from a corner
/// to a position that was collapsed onto it.
double ChannelFit::lengthOf(const simplify::Triangle& t) const {
    double moved = 0;
    double reach = 0;
    for (const std::uint32_t v : t) {
        const std::uint32_t p = patch_.positionOf[v];
        moved = std::max(moved, glm::length(patch_.positions[p] - patch_.positions[simplified_.movedTo[p]]));
        reach = std::max(reach, reach_[p]);
    }
    return moved > 0 ? moved : reach;
}

/// Takes samples on triangle `number` of the original patch. Adds the attribute difference of each sample to the
/// corners of the simplified triangle that is nearest to the sample.
void ChannelFit::compare(std::uint32_t number) {
    const simplify::Triangle& t = patch_.triangles[number];
    const std::array<glm::dvec3, 3> places = surface_.placesOf(t);
    const auto area = static_cast<float>(glm::length(glm::cross(places[1] - places[0], places[2] - places[0])));
    if (isPlain(t)) { // the residual is zero, but the area of the triangle counts
        for (const std::uint32_t v : t)
            plainWeight_[simplified_.positionOf(patch_, v)] += area;
        return;
    }
    gatherCandidates(t);
    if (candidates_.empty()) return;
    const double length = std::max(lengthOf(t), 0.5 * widthOf(places));
    for (const Weights& at : kSampleWeights) {
        const glm::dvec3 p = places[0] * static_cast<double>(at[0]) + places[1] * static_cast<double>(at[1]) +
                             places[2] * static_cast<double>(at[2]);
        const std::uint32_t triangle = surface_.nearest(p, candidates_);
        const simplify::Triangle& coarse = simplified_.triangles[triangle];
        const glm::vec3 weights(weightsAt(p, surface_.placesOfSimplified(triangle)));
        Sample sample{mixed(t, at), {weights.x, weights.y, weights.z}, triangle, length};
        const Channels there = found(sample);
        for (std::size_t corner = 0; corner < coarse.size(); ++corner) {
            const float share = area * sample.weights[corner];
            weight_[coarse[corner]] += share;
            for (std::size_t i = 0; i < there.size(); ++i)
                residual_[coarse[corner]][i] += share * (sample.channels[i] - there[i]);
        }
        samples_.push_back(sample);
    }
}

} // namespace gnomon::levels
