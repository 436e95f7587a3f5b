// How far edges of shadows at one pixel of error lie from those of the finest level, over all casters, with the sun
// before, beside and behind the camera: by how far off what casts is, and beside what full detail differs from itself.
// usage: shadow_edges VIEWS [SIDE [SAMPLES [ERROR_PIXELS]]] -- MODEL.gnm PATH.json ...
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

constexpr double kContactPixels = 2; // a caster nearer to what it shadows touches it

struct Sampling {
    int views = 20;
    int side = 320;
    int samples = 4; // along each side of a pixel
    double errorPixels = 1;
};

/// Distances in pixels, by what they are of.
struct Distances {
    std::vector<float> chance; // full detail half a sample aside, from full detail
    std::vector<float> cut;    // the cut's, from full detail
    std::vector<float> full;   // full detail's, from the cut
    std::vector<float> cast;   // of `cut`, where what casts is further than kContactPixels away
    std::vector<float> touching;
    std::array<std::vector<float>, 3>
        slant; // of `cut`, where the light meets the receiver at 10, 20, 37 degrees or more
    std::uint64_t cutTriangles = 0;
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

class Bench {
public:
    Bench(const std::string& model, const Sampling& sampling)
        : sampling_(sampling),
          model_(model, gibibytes(1)),
          renderer_(model_, *backend_, {.memory = gibibytes(4), .onDamaged = {}}) {}

    Distances measure(const path::CameraPath& path) {
        plan::View view;
        view.width = view.height = sampling_.side;
        view.up = glm::normalize(model_.summary().up.direction);
        for (int i = 0; i < sampling_.views; ++i) {
            view.camera =
                path::cameraAt(path, path::frameTime(path, i, sampling_.views + 1)); // orbits end as they began
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
    DrawnReach draw(const plan::View& view, double errorPixels, const glm::dvec2& aside = {}) {
        return tests::drawReach(renderer_, view, errorPixels, sampling_.samples, aside);
    }

    void addView(const plan::View& view) {
        constexpr double kFullDetail = 1e-4;
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

    /// The cut's edges by slant, and by how far off what casts is; `cut` is the last frame that was prepared.
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
