// Gnomon as a library: builds level-of-detail models of meshes, cuts them, draws them with their shadows, and answers
// what shadow maps cost. All of it fails by std::runtime_error, what() being one line: what, where, expected, found.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#define GNOMON_API __attribute__((visibility("default")))

namespace gnomon::api {

/// "MAJOR.MINOR.PATCH": versions of one MAJOR, and before 1 of one MINOR, replace each other without compiling anew.
GNOMON_API std::string version();

/// Options of `gnomon render` that say what a view is and how good, by their names without dashes, and their values as
/// a command line has them: {{"size", "800x600"}, {"eye", "60,2,100"}, {"shadows", "exact"}}. `gnomon render --help`
/// lists them; what is not given is as it is by default.
using Options = std::map<std::string, std::string>;

/// Told how far long work is: `done` of `total` units of a stage; may be called from any thread. Where it returns false
/// the work ends, and throws.
using OnProgress = std::function<bool(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

// Builds -------------------------------------------------------------------------------------------------------------

struct BuildOptions {
    std::uint64_t memory = std::uint64_t{2} << 30U; // bytes that the process may take
    int threads = 0;                                // 0: as many as there are cores
    std::string temporaryFolder{};                  // empty: beside the output
    std::vector<std::string> fields{};              // scalar properties of the vertices of a PLY to keep
    std::string up = "auto";                        // x, y, z, -x, -y, -z, a direction "x,y,z", or guessed
    std::string unit = "m";                         // m, cm, mm, ft, in: of the coordinates
    std::string sourceRoot{};                       // folder of textures, buffers, libraries; empty: the input's
};

/// Builds the model `output`, a .gnm, of `inputs` (PLY, glTF, OBJ, STL, OFF), out of core. Returns what `gnomon build
/// --json` prints. The bytes are the same for any memory and any number of threads.
GNOMON_API std::string build(
    const std::vector<std::string>& inputs,
    const std::string& output,
    const BuildOptions& options = {},
    const OnProgress& onProgress = {});

// Models: hierarchy and selection ------------------------------------------------------------------------------------

/// Triangles of one cut of a model.
struct Mesh {
    std::vector<double> positions;        // x, y, z of each vertex, in the source's axes and units
    std::vector<float> normals;           // x, y, z of each, unit vectors; 0, 0, 0 where the source has none
    std::vector<std::uint8_t> colors;     // red, green, blue, alpha of each, sRGB
    std::vector<std::uint32_t> triangles; // three vertices each, counter-clockwise from outside
    double error = 0;                     // no point of the source is farther from it by more than that, units
};

/// A picture as a person sees it: rows from top to bottom, red, green, blue and alpha of each pixel, sRGB.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// An open model. Several may be used at once, but each by one thread at a time.
class GNOMON_API Model {
public:
    /// Opens a .gnm on disk or at an http(s):// address. Tables and pages take at most `memory` bytes.
    explicit Model(const std::string& path, std::uint64_t memory = std::uint64_t{1} << 30U);
    ~Model();
    Model(Model&&) noexcept;
    Model& operator=(Model&&) noexcept;
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    /// What `gnomon info --json` prints: triangles, levels, errors, bounds, up, unit, hash.
    std::string info() const;

    /// The coarsest uniform cut that is nowhere farther off than `error`, in units.
    Mesh cutByError(double error) const;

    /// The finest uniform cut of at most so many triangles.
    Mesh cutByTriangles(std::uint64_t most) const;

    /// What a view shows: nothing in it is off by more than the option error-pixels. Vertices on borders of clusters
    /// are there several times; `error` is the largest of all clusters.
    Mesh cutForView(const Options& options) const;

    /// What `gnomon explain --json` prints: the plan of one frame, and why it leaves out what it leaves out.
    std::string plan(const Options& options) const;

    /// Draws a view on the processor, as `gnomon render` does, to the byte: the mean of so many frames.
    Picture render(const Options& options, int samples = 16) const;

    /// What of the model could not be read since it was opened, a line each; its parents are drawn in its place.
    const std::vector<std::string>& damage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Shadow maps --------------------------------------------------------------------------------------------------------

/// What a scheme of warping and partitioning costs (Lloyd et al. 2006).
struct ShadowScheme {
    std::string scheme;       // ZP: slices by depth, FP: faces of the frustum, +W: warped
    std::string warp;         // as the option warp has it
    int slices = 1;           // by depth
    int maps = 1;             // in all
    double storageFactor = 0; // S: texels over pixels, where no texel is wider than a pixel
    double worstAcross = 0;   // M_x and M_z: the widest texel over a pixel, were each map one texel for each pixel
    double worstAlong = 0;
};

/// Every scheme with 1 to 8 slices, for a view frustum between the depths `near` and `far`, a full vertical angle in
/// degrees, its width over its height, and the direction towards the light as right, up and along the view.
GNOMON_API std::vector<ShadowScheme> shadowSchemes(
    double near, double far, double fovYDegrees, double aspect, const std::array<double, 3>& towardsLight);

} // namespace gnomon::api
