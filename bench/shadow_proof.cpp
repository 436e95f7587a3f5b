// Tests shadow maps against their aliasing bound and counts the pixels that differ from ray-traced shadows.
//
// usage: shadow_proof MODEL.gnm TRIPLES IMAGE_SIDE TEXEL_SIDE [VERDICT_PICTURES_DIR]
//
// The program draws TRIPLES seeded combinations of view, light and shadow scheme. Images have IMAGE_SIDE x IMAGE_SIDE
// pixels. The shadow maps have TEXEL_SIDE x TEXEL_SIDE texels in total.
//
// First, each triple is drawn with its scheme. The program prints the max ratio of the measured aliasing to the
// aliasing bound (promise). It also prints the number of triples with a ratio above 1.
//
// Then each triple is drawn with the default settings, and compared with ray-traced shadows of the same clusters. The
// program prints the wrong pixels by cause, in percent of the pixels that face the light. The last line counts false
// shadows and leaks, in percent of the pixels with N.L > 0.1.
//
// With VERDICT_PICTURES_DIR, the program writes one PNG file per triple that colours wrong pixels by cause.
//
// The exit code is 1 if a bound is broken, or if the last line exceeds 0.05%.
#include "core/error.h"
#include "render/software_backend.h"
#include "tests/support/shadow_triples.h"
#include "validation/frame_validation.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace gnomon {
namespace {

constexpr double kFloatTolerance = 1e-3; // a bound is broken if the ratio exceeds 1 by more than this value

/// The results of all triples of one model.
struct Tally {
    std::uint64_t triples = 0;
    std::uint64_t pixels = 0;       // pixels that face the light, with the default settings
    double overBound = 0;           // max ratio of measured aliasing to the aliasing bound, over all schemes
    std::uint64_t boundsBroken = 0; // triples whose aliasing exceeds the bound
    // The following counts are pixels with the default settings.
    std::uint64_t judged = 0;      // N.L > 0.1
    std::uint64_t unexplained = 0; // false shadows and leaks with N.L > 0.1
    double worstUnexplained = 0;   // max fraction of unexplained pixels of one image
    std::uint64_t contactGaps = 0;
    std::uint64_t falseShadows = 0; // for all N.L
    std::uint64_t leaks = 0;        // for all N.L
    std::uint64_t missed = 0;       // the caster is thinner than a texel
    std::uint64_t wrong = 0;
};

/// Returns `picture` with wrong pixels coloured by cause: blue near an edge, orange for contact gaps, green for missed
/// casters, red for false shadows, and magenta for leaks.
render::Picture verdictPicture(const validation::ShadowTruth& truth, const render::Picture& picture) {
    render::Picture result = picture;
    for (std::size_t i = 0; i < truth.verdicts.size(); ++i) {
        switch (truth.verdicts[i]) {
        case validation::ShadowVerdict::NearEdge:
            result.pixels[i] = {90, 140, 255};
            break;
        case validation::ShadowVerdict::ContactGap:
            result.pixels[i] = {255, 190, 0};
            break;
        case validation::ShadowVerdict::Missed:
            result.pixels[i] = {0, 190, 90};
            break;
        case validation::ShadowVerdict::FalseShadow:
            result.pixels[i] = {255, 0, 0};
            break;
        case validation::ShadowVerdict::Leak:
            result.pixels[i] = {255, 0, 255};
            break;
        default:
            break;
        }
    }
    return result;
}

/// Draws and validates the triples of one model.
class Validation {
public:
    Validation(const std::string& model, int side, int texels)
        : model_(model), side_(side), texels_(texels), renderer_(model_, *backend_, {}) {}

    /// Validates triple `index`. Writes the coloured image to the folder `pictures`, if the name is not empty.
    void add(std::uint64_t index, const std::string& pictures) {
        const tests::ShadowTriple triple = tests::shadowTriple(model_.summary().bounds, index, side_, texels_);
        addBound(index, triple);
        const validation::FrameValidation proof = proven(withDefaults(triple), validation::GroundTruth::SameDetail);
        ++tally_.triples;
        if (!proof.truth) return;
        const validation::ShadowTruth& truth = *proof.truth;
        tally_.judged += truth.judgedPixels;
        tally_.unexplained += truth.unexplainedPixels;
        tally_.worstUnexplained = std::max(tally_.worstUnexplained, truth.unexplainedFraction());
        tally_.pixels += truth.shadows.litSidePixels;
        tally_.missed += truth.missedPixels;
        tally_.wrong += truth.shadows.wrongPixels;
        const auto count = [&](validation::ShadowVerdict verdict) {
            return static_cast<std::uint64_t>(std::count(truth.verdicts.begin(), truth.verdicts.end(), verdict));
        };
        tally_.contactGaps += count(validation::ShadowVerdict::ContactGap);
        tally_.falseShadows += count(validation::ShadowVerdict::FalseShadow);
        tally_.leaks += count(validation::ShadowVerdict::Leak);
        if (pictures.empty()) return;
        std::printf(
            "%3llu: %llu of %llu unexplained\n",
            static_cast<unsigned long long>(index),
            static_cast<unsigned long long>(truth.unexplainedPixels),
            static_cast<unsigned long long>(truth.judgedPixels));
        render::writePng(
            pictures + "/verdict" + std::to_string(index) + ".png", verdictPicture(truth, backend_->picture()));
    }

    const Tally& tally() const { return tally_; }

private:
    /// Draws `triple`, and measures its aliasing and its wrong pixels.
    validation::FrameValidation proven(const tests::ShadowTriple& triple, validation::GroundTruth groundTruth) {
        validation::ValidationOptions options;
        options.groundTruth = groundTruth;
        options.measuresAliasing = true;
        return validation::validate(renderer_, renderer_.render(triple.view, triple.quality, {}), options);
    }

    /// Compares the measured aliasing of `triple` with its bound, and prints a message if the bound is broken.
    void addBound(std::uint64_t index, const tests::ShadowTriple& triple) {
        const validation::FrameValidation proof = proven(triple, validation::GroundTruth::None);
        if (!proof.aliasing) return;
        tally_.overBound = std::max(tally_.overBound, proof.aliasing->overBound);
        if (proof.aliasing->overBound <= 1 + kFloatTolerance) return;
        ++tally_.boundsBroken;
        std::printf(
            "triple %llu breaks its promise: %.4f of it, %s\n",
            static_cast<unsigned long long>(index),
            proof.aliasing->overBound,
            tests::describe(triple).c_str());
    }

    hierarchy::ModelFile model_;
    int side_;
    int texels_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_;
    Tally tally_;
};

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

int run(int count, char** arguments) {
    if (count < 5) {
        std::fprintf(
            stderr, "usage: %s MODEL.gnm TRIPLES IMAGE_SIDE TEXEL_SIDE [VERDICT_PICTURES_DIR]\n", arguments[0]);
        return 2;
    }
    Validation proof(arguments[1], std::atoi(arguments[3]), std::atoi(arguments[4]));
    const auto triples = static_cast<std::uint64_t>(std::atoi(arguments[2]));
    for (std::uint64_t i = 0; i < triples; ++i)
        proof.add(i, count > 5 ? arguments[5] : "");
    const Tally& t = proof.tally();
    std::printf(
        "%s: %llu triples; measured over promised at most %.4f (%llu broken)\n"
        "  default settings, lit-side pixels: %.3f%% wrong, of which missed thin casters %.3f%%, contact gaps %.4f%%,\n"
        "  false shadows %.4f%%, leaks %.4f%%\n"
        "  beyond a footprint where N.L > 0.1: %.4f%% of %llu (worst picture %.3f%%)\n",
        arguments[1],
        static_cast<unsigned long long>(t.triples),
        t.overBound,
        static_cast<unsigned long long>(t.boundsBroken),
        percent(t.wrong, t.pixels),
        percent(t.missed, t.pixels),
        percent(t.contactGaps, t.pixels),
        percent(t.falseShadows, t.pixels),
        percent(t.leaks, t.pixels),
        percent(t.unexplained, t.judged),
        static_cast<unsigned long long>(t.judged),
        100 * t.worstUnexplained);
    return t.boundsBroken == 0 && percent(t.unexplained, t.judged) <= 0.05 ? 0 : 1;
}

} // namespace
} // namespace gnomon

int main(int count, char** arguments) {
    try {
        return gnomon::run(count, arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shadow_proof: %s\n", error.what());
        return 1;
    }
}
