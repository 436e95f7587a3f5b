// Measures the distance between shadow edges at a reduced level of detail and at full detail, in pixels.
//
// usage: shadow_edges VIEWS [SIDE [SAMPLES [ERROR_PIXELS]]] -- MODEL.gnm PATH.json ...
//
// The program draws VIEWS views along each camera path, with the sun in front of, beside and behind the camera. Images
// have SIDE x SIDE pixels (default: 320), SAMPLES x SAMPLES samples per pixel (default: 4) and exact shadows. The
// reduced level of detail has an error of at most ERROR_PIXELS pixels (default: 1).
//
// The program prints a table per model and for all models. Its columns are the number of edge samples, percentiles of
// the distance, and the share above 1.5 pixels. The rows are:
// - full detail half a sample aside: noise floor, full detail against full detail with shifted samples
// - full detail, from the cut's: edges at full detail, distance to the nearest edge at reduced detail
// - the cut, from full detail's: edges at reduced detail, distance to the nearest edge at full detail
// - further rows: the same edges, by the distance to the caster and by the angle between light and receiver
#include "tests/frame/shadow_edges.h"

#include "core/error.h"
#include "path/camera_path.h"
#include "render/ray_shadows.h"
#include "render/software_backend.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace gnomon {
namespace {

using tests::DrawnReach;

constexpr double kContactPixels = 2; // a caster touches its receiver if it is nearer than this distance

struct Sampling {
    int views = 20;         // views per camera path
    int side = 320;         // width and height of the image, in pixels
    int samples = 4;        // samples per pixel along each axis
    double errorPixels = 1; // error limit of the reduced level of detail, in pixels
};

/// Distances from the samples of shadow edges to the nearest shadow edge of another image, in pixels. `cut` is the
/// image at reduced level of detail.
struct Distances {
    std::vector<float> chance;   // from full detail with shifted samples to full detail
    std::vector<float> cut;      // from the cut to full detail
    std::vector<float> full;     // from full detail to the cut
    std::vector<float> cast;     // the part of `cut` with casters at least kContactPixels from the receiver
    std::vector<float> touching; // the part of `cut` with nearer casters
    // The parts of `cut` by the angle between light and receiver: 10 to 20, 20 to 37, and at least 37 degrees.
    std::array<std::vector<float>, 3> slant;
    std::uint64_t cutTriangles = 0; // triangles of the images, summed over all views
    std::uint64_t fullTriangles = 0;

    void append(const Distances& other);
};

void appendTo(std::vector<float>& all, const std::vector<float>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

void Distances::append(const Distances& other) {
    appendTo(chance, other.chance);
    appendTo(cut, other.cut);
    appendTo(full, other.full);
    appendTo(cast, other.cast);
    appendTo(touching, other.touching);
    for (std::size_t i = 0; i < slant.size(); ++i)
        appendTo(slant[i], other.slant[i]);
    cutTriangles += other.cutTriangles;
    fullTriangles += other.fullTriangles;
}

/// Prints the number of `distances`, their median, 95th and 99th percentile, and the share above 1.5 pixels.
void printRow(const std::string& name, std::vector<float> distances) {
    if (distances.empty()) return;
    std::sort(distances.begin(), distances.end());
    const auto at = [&](double share) {
        const auto place = static_cast<std::size_t>(share * static_cast<double>(distances.size()));
        return static_cast<double>(distances[std::min(place, distances.size() - 1)]);
    };
    const auto over = distances.end() - std::upper_bound(distances.begin(), distances.end(), 1.5F);
    std::printf(
        "| %s | %zu | %.2f | %.2f | %.2f | %.2f%% |\n",
        name.c_str(),
        distances.size(),
        at(0.5),
        at(0.95),
        at(0.99),
        100.0 * static_cast<double>(over) / static_cast<double>(distances.size()));
}

void print(const std::string& name, const Distances& distances) {
    std::printf("| %s | samples | median | 95%% | 99%% | over 1.5 |\n|---|---|---|---|---|---|\n", name.c_str());
    printRow("full detail half a sample aside", distances.chance);
    printRow("full detail, from the cut's", distances.full);
    printRow("**the cut, from full detail's**", distances.cut);
    printRow("what casts is 2 pixels away or more", distances.cast);
    printRow("what casts is nearer", distances.touching);
    printRow("light at 10 to 20 degrees", distances.slant[0]);
    printRow("light at 20 to 37 degrees", distances.slant[1]);
    printRow("light at 37 degrees or more", distances.slant[2]);
    std::printf(
        "triangles in view: %llu of %llu\n\n",
        static_cast<unsigned long long>(distances.cutTriangles),
        static_cast<unsigned long long>(distances.fullTriangles));
    std::fflush(stdout);
}

/// Draws one model and measures the distances between its shadow edges.
class Bench {
public:
    Bench(const std::string& model, const Sampling& sampling)
        : sampling_(sampling),
          model_(model, gibibytes(1)),
          renderer_(model_, *backend_, {.memory = gibibytes(4), .onDamaged = {}}) {}

    /// Draws all views along `path`, each one with three suns, and returns all distances.
    Distances measure(const path::CameraPath& path) {
        plan::View view;
        view.width = view.height = sampling_.side;
        view.up = glm::normalize(model_.summary().up.direction);
        for (int i = 0; i < sampling_.views; ++i) {
            view.camera = path::cameraAt(
                path,
                path::frameTime(path, i, sampling_.views + 1)); // an orbit ends at its first view, which is skipped
            const glm::dvec3 towards = view.camera.target - view.camera.eye;
            const glm::dvec3 ahead = glm::normalize(towards - view.up * glm::dot(towards, view.up));
            for (const glm::dvec3& sun : {ahead, glm::cross(ahead, view.up), -ahead}) {
                view.towardsLight = sun + 0.8 * view.up;
                addView(view);
            }
        }
        return std::move(distances_);
    }

private:
    /// Draws `view` with exact shadows. `aside` shifts all samples, in samples.
    DrawnReach draw(const plan::View& view, double errorPixels, const glm::dvec2& aside = {}) {
        return tests::drawReach(renderer_, view, errorPixels, sampling_.samples, aside);
    }

    /// Draws `view` at full detail, at full detail with shifted samples, and at reduced detail. Adds the distances
    /// between the shadow edges.
    void addView(const plan::View& view) {
        constexpr double kFullDetail = 1e-4; // error limit in pixels
        const DrawnReach full = draw(view, kFullDetail);
        const DrawnReach aside = draw(view, kFullDetail, {0.37, 0.25});
        const DrawnReach cut = draw(view, sampling_.errorPixels);
        add(edgeDistances(aside.picture, full.picture), distances_.chance);
        add(edgeDistances(full.picture, cut.picture), distances_.full);
        const std::vector<float> found = edgeDistances(cut.picture, full.picture);
        add(found, distances_.cut);
        distances_.cutTriangles += cut.frame.cut.lists.image.triangles;
        distances_.fullTriangles += full.frame.cut.lists.image.triangles;
        addClasses(cut, found);
    }

    void add(const std::vector<float>& found, std::vector<float>& distances) const {
        for (const float distance : found)
            if (distance >= 0) distances.push_back(inPixels(distance));
    }

    float inPixels(float samples) const { return samples / static_cast<float>(sampling_.samples); }

    /// Distributes the distances `found` of the image `cut` to the classes of `distances_`, by caster distance and
    /// light angle. `cut` must be the last prepared frame.
    void addClasses(const DrawnReach& cut, const std::vector<float>& found) {
        const render::DrawInputs drawing = renderer_.drawing(cut.frame, {});
        const raytrace::Scene scene = render::rayScene(drawing, cut.frame.cut.lists.all());
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (found[i] < 0) continue;
            const render::SurfaceSample& surface = cut.surfaces.pixels[i];
            const double sample = render::pixelWidth(cut.frame.plan, cut.frame.space, glm::dvec3(surface.position));
            raytrace::Ray ray{surface.position, cut.frame.plan.light.unit()};
            ray.tMin = static_cast<float>(render::kContactTolerancePixels * sample);
            const auto hit = scene.firstHit(ray);
            const bool isCast = hit && hit->distance >= kContactPixels * sampling_.samples * sample;
            (isCast ? distances_.cast : distances_.touching).push_back(inPixels(found[i]));
            const float sine = cut.picture.samples[i].sine;
            const std::size_t slant = sine < 0.342F ? 0 : sine < 0.6F ? 1 : 2;
            distances_.slant[slant].push_back(inPixels(found[i]));
        }
    }

    Sampling sampling_;
    hierarchy::ModelFile model_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_;
    Distances distances_;
};

int run(int count, char** words) {
    const auto parting = static_cast<int>(
        std::find_if(words, words + count, [](const char* word) { return std::string(word) == "--"; }) - words);
    if (parting < 2 || count < parting + 3 || (count - parting) % 2 == 0) {
        std::fprintf(stderr, "usage: shadow_edges VIEWS [SIDE [SAMPLES [ERROR_PIXELS]]] -- MODEL.gnm PATH.json ...\n");
        return 2;
    }
    Sampling sampling;
    sampling.views = std::atoi(words[1]);
    if (parting > 2) sampling.side = std::atoi(words[2]);
    if (parting > 3) sampling.samples = std::atoi(words[3]);
    if (parting > 4) sampling.errorPixels = std::atof(words[4]);
    Distances all;
    for (int i = parting + 1; i + 1 < count; i += 2) {
        const Distances found = Bench(words[i], sampling).measure(path::readCameraPath(words[i + 1]));
        print(words[i], found);
        all.append(found);
    }
    print("all", all);
    return 0;
}

} // namespace
} // namespace gnomon

int main(int count, char** words) {
    try {
        return gnomon::run(count, words);
    } catch (const gnomon::Error& error) {
        std::fprintf(stderr, "shadow_edges: %s\n", error.what());
        return 1;
    }
}
