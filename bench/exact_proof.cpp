// Counts the pixels whose exact shadow differs from a brute-force test with integers.
//
// usage: exact_proof VIEWS WxH [lamps] MODEL.gnm...
//
// The program draws VIEWS seeded views of each model, with W x H pixels. The light is a seeded sun. With
// `lamps`, it is a seeded point light. A second computation tests each sample against all casters. A sample is a
// visible point that faces the light.
//
// The program prints each view with wrong pixels, and then per model and for all models:
// - samples, and pixels whose lit or dark result differs between both computations
// - dark samples, and dark samples if the tolerance were 0
// - touching samples: their result depends on the tolerance or on the rule for ties; also the max share of a view
// - sample tests, and tests that needed integer arithmetic; also the max share of a view
// - a hash of all counts, which is equal for all compilers and all numbers of threads
//
// The exit code is 1 if a pixel is wrong.
#include "frame/renderer.h"
#include "render/exact_pass.h"
#include "render/software_backend.h"
#include "tests/support/shadow_triples.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace gnomon {
namespace {

using Count = unsigned long long;

/// The counts of several views.
struct Tally {
    Count views = 0;
    Count drawn = 0;   // views with a surface that can be in shadow
    Count samples = 0; // visible points that face the light
    Count wrong = 0;   // pixels that differ from the brute-force result
    Count dark = 0;
    Count darkWithoutTolerance = 0; // dark samples if the tolerance were 0
    Count withinTolerance = 0;      // samples whose result depends on the tolerance or on the rule for ties
    Count tests = 0;                // tests of one triangle against one sample
    Count exactDecisions = 0;       // tests that needed integer arithmetic
    double worstDecisions = 0;      // max over the views: exactDecisions / tests
    // max over the views with at least kMany samples: withinTolerance / samples
    double worstWithinTolerance = 0;
    Count worstView = 0;                  // index of the view with this max
    Count above = 0;                      // views whose share within tolerance exceeds kMaxWithinTolerance
    Count digest = 14695981039346656037U; // FNV-1a hash of the counts, equal for all compilers and thread counts

    void operator+=(const Tally& other);
};

constexpr Count kMany = 500; // views with fewer samples do not count for worstWithinTolerance and above
constexpr double kMaxWithinTolerance = 0.005; // fraction of a view's samples

void Tally::operator+=(const Tally& other) {
    views += other.views;
    drawn += other.drawn;
    samples += other.samples;
    wrong += other.wrong;
    dark += other.dark;
    darkWithoutTolerance += other.darkWithoutTolerance;
    withinTolerance += other.withinTolerance;
    tests += other.tests;
    exactDecisions += other.exactDecisions;
    above += other.above;
    worstDecisions = std::max(worstDecisions, other.worstDecisions);
    worstWithinTolerance = std::max(worstWithinTolerance, other.worstWithinTolerance);
    digest = (digest ^ other.digest) * 1099511628211U;
}

double share(Count part, Count whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Draws seeded views of one model and sums their counts.
class Validation {
public:
    Validation(const std::string& model, int width, int height, bool hasLamps)
        : hasLamps_(hasLamps),
          model_(model, Bytes{Count{1} << 30U}),
          width_(width),
          height_(height),
          renderer_(model_, *backend_, {}) {}

    /// Draws view `index`, and adds its counts and wrong pixels.
    void add(Count index) {
        tests::ShadowTriple triple = tests::shadowTriple(model_.summary().bounds, index, width_, 256);
        triple.view.height = height_;
        if (hasLamps_) triple.view.pointLight = tests::lampFor(model_.summary().bounds, triple.view, index);
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Exact;
        frame::PreparedFrame frame = renderer_.prepare(triple.view, quality);
        ++tally_.views;
        if (!frame.isExact()) return;
        ++tally_.drawn;
        frame::FrameOptions options;
        options.wantsSurfaces = true;
        const render::DrawStatistics drawn = renderer_.draw(frame, options);
        if (drawn.exact) addCounts(index, *drawn.exact);
        addWrong(index, frame, options);
    }

    const Tally& tally() const { return tally_; }

private:
    void addCounts(Count index, const exact::ExactStatistics& exact) {
        tally_.samples += exact.samples;
        tally_.dark += exact.dark;
        tally_.darkWithoutTolerance += exact.darkWithoutTolerance;
        tally_.withinTolerance += exact.withinTolerance;
        tally_.tests += exact.counts.sampleTests;
        tally_.exactDecisions += exact.counts.exactDecisions;
        tally_.worstDecisions =
            std::max(tally_.worstDecisions, share(exact.counts.exactDecisions, exact.counts.sampleTests));
        for (const Count count :
             {exact.samples,
              exact.dark,
              exact.darkWithoutTolerance,
              exact.withinTolerance,
              exact.counts.clustersKept,
              exact.counts.trianglesRasterized,
              exact.counts.sampleTests})
            tally_.digest = (tally_.digest ^ count) * 1099511628211U;
        if (exact.samples < kMany) return;
        const double withinTolerance = share(exact.withinTolerance, exact.samples);
        tally_.above += withinTolerance > kMaxWithinTolerance ? 1 : 0;
        if (withinTolerance <= tally_.worstWithinTolerance) return;
        tally_.worstWithinTolerance = withinTolerance;
        tally_.worstView = index;
    }

    /// Compares the shadow of each pixel with the brute-force result, and prints the number of wrong pixels.
    void addWrong(Count index, const frame::PreparedFrame& frame, const frame::FrameOptions& options) {
        const render::Raster<render::SurfaceSample> surfaces = backend_->surfaces();
        render::DrawInputs drawing = renderer_.drawing(frame, options);
        drawing.exactCasters = &frame.cut.lists.casters.at(0);
        const render::Raster<std::uint8_t> truth = render::litByIntegers(drawing);
        Count wrong = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            const render::SurfaceSample& surface = surfaces.pixels[i];
            const bool isLit = surface.isLitSide() && surface.litFraction() >= 0.5F;
            wrong += isLit != (truth.pixels[i] != 0) ? 1U : 0U;
        }
        if (wrong > 0) std::printf("view %llu: %llu pixels wrong\n", index, wrong);
        tally_.wrong += wrong;
    }

    bool hasLamps_;
    hierarchy::ModelFile model_;
    int width_;
    int height_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_;
    Tally tally_;
};

void print(const std::string& name, const Tally& t) {
    std::printf(
        "%s: %llu views (%llu with anything in them), %llu samples, %llu pixels wrong\n"
        "  dark %llu, with a tolerance of 0 %llu; touching %llu (%.4f%% of all, worst view %.4f%%: %llu; above 0.5%%: "
        "%llu)\n"
        "  tests %llu, by integers %llu (worst view 1 in %.0f), counts %016llx\n",
        name.c_str(),
        t.views,
        t.drawn,
        t.samples,
        t.wrong,
        t.dark,
        t.darkWithoutTolerance,
        t.withinTolerance,
        100 * share(t.withinTolerance, t.samples),
        100 * t.worstWithinTolerance,
        t.worstView,
        t.above,
        t.tests,
        t.exactDecisions,
        t.worstDecisions > 0 ? 1 / t.worstDecisions : 0,
        t.digest);
    std::fflush(stdout);
}

int run(int count, char** arguments) {
    if (count < 4) {
        std::fprintf(stderr, "usage: %s VIEWS WxH [lamps] MODEL.gnm...\n", arguments[0]);
        return 2;
    }
    const auto views = static_cast<Count>(std::atoi(arguments[1]));
    const std::string size = arguments[2];
    const bool hasLamps = std::string(arguments[3]) == "lamps";
    Tally all;
    for (int i = hasLamps ? 4 : 3; i < count; ++i) {
        Validation proof(
            arguments[i], std::atoi(size.c_str()), std::atoi(size.substr(size.find('x') + 1).c_str()), hasLamps);
        for (Count view = 0; view < views; ++view)
            proof.add(view);
        print(arguments[i], proof.tally());
        all += proof.tally();
    }
    print("all", all);
    return all.wrong == 0 ? 0 : 1;
}

} // namespace
} // namespace gnomon

int main(int count, char** arguments) {
    try {
        return gnomon::run(count, arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "exact_proof: %s\n", error.what());
        return 1;
    }
}
