// The public interface of the Gnomon library. It builds level-of-detail models from meshes, exports them as meshes at
// any level of detail, draws them with shadows, and computes the cost of shadow maps. Functions fail with
// std::runtime_error. what() is one line with the failure, its place, the expected value and the found value.
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

/// Returns the version of the library as "MAJOR.MINOR.PATCH". Versions with the same MAJOR (before 1.0: the same MINOR)
/// are binary compatible.
GNOMON_API std::string version();

/// The options of a view and its quality, as for `gnomon render`. Keys are the option names without dashes, and values
/// have the format of the command line: {{"size", "800x600"}, {"eye", "60,2,100"}, {"shadows", "exact"}}. `gnomon
/// render --help-all` lists all options. An option that is not in the map has its default.
using Options = std::map<std::string, std::string>;

/// The user's function that receives the progress of a long task: `done` of `total` units of a stage are finished. Any
/// thread can call it. If it returns false, the task stops and throws.
using OnProgress = std::function<bool(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

// Builds -------------------------------------------------------------------------------------------------------------

struct BuildOptions {
    std::uint64_t memory = std::uint64_t{2} << 30U; // max memory of the process, in bytes
    int threads = 0;                                // 0: one thread per core
    std::string temporaryFolder{};                  // empty: the folder of the output
    std::vector<std::string> fields{};              // scalar vertex properties of a PLY file that the model stores
    std::string up = "auto";                        // x, y, z, -x, -y, -z, a direction "x,y,z", or "auto" for a guess
    std::string unit = "m";                         // unit of the coordinates: m, cm, mm, ft or in
    // Folder of textures, buffers and libraries that the inputs may use. If it is empty, it is the folder of the
    // input.
    std::string sourceRoot{};
};

/// Builds the model file `output` (.gnm) from the meshes `inputs` (PLY, glTF, OBJ, STL, OFF) out of core. Returns the
/// report that `gnomon build --json` prints. The bytes of the model do not depend on memory or the number of threads.
GNOMON_API std::string build(
    const std::vector<std::string>& inputs,
    const std::string& output,
    const BuildOptions& options = {},
    const OnProgress& onProgress = {});

// Models: hierarchy and selection ------------------------------------------------------------------------------------

/// The triangles of a model at chosen levels of detail (a cut). Each part of the surface occurs once.
struct Mesh {
    std::vector<double> positions;        // x, y, z per vertex, in the axes and units of the source
    std::vector<float> normals;           // x, y, z per vertex, unit length; 0, 0, 0 if the source has no normals
    std::vector<std::uint8_t> colors;     // red, green, blue, alpha per vertex, sRGB
    std::vector<std::uint32_t> triangles; // three vertex indices per triangle, counter-clockwise seen from outside
    double error = 0;                     // upper bound of the distance between the source and this mesh, in units
};

/// An image with rows from top to bottom. Each pixel has red, green, blue and alpha in sRGB.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// An open model. Different threads can use different models at the same time, but only one thread at a time can use
/// one model.
class GNOMON_API Model {
public:
    /// Opens a .gnm model from a path or an http(s):// address. Its tables and pages use at most `memory` bytes.
    explicit Model(const std::string& path, std::uint64_t memory = std::uint64_t{1} << 30U);
    ~Model();
    Model(Model&&) noexcept;
    Model& operator=(Model&&) noexcept;
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    /// Returns the JSON that `gnomon info --json` prints: triangles, levels, errors, bounds, up direction, unit and
    /// hash.
    std::string info() const;

    /// Returns the coarsest mesh of the model whose error is at most `error`, in units of the model. All parts have the
    /// same error limit.
    Mesh cutByError(double error) const;

    /// Returns the finest mesh of the model with at most `maxTriangles` triangles. All parts have the same error limit.
    Mesh cutByTriangles(std::uint64_t maxTriangles) const;

    /// Returns the mesh that is drawn for a view. Its error on the screen is at most the option error-pixels. Vertices
    /// on borders of clusters are duplicated. `error` of the mesh is the largest error of all clusters.
    Mesh cutForView(const Options& options) const;

    /// Returns the JSON that `gnomon explain --json` prints: the shadow maps and other passes of one frame, with a
    /// reason for each skipped effect.
    std::string plan(const Options& options) const;

    /// Draws a view on the CPU and returns the mean of `samples` frames. The result is identical to the picture of
    /// `gnomon render`.
    Picture render(const Options& options, int samples = 16) const;

    /// Returns one line for each part of the model that could not be read since it was opened. Coarser geometry is
    /// drawn instead of these parts.
    const std::vector<std::string>& damage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Shadow maps --------------------------------------------------------------------------------------------------------

/// The cost of a shadow map scheme, which is a combination of partitions of the view and warp (Lloyd et al. 2006).
struct ShadowScheme {
    std::string scheme;       // ZP: partitions by depth, FP: partitions by frustum face, +W: with a warp
    std::string warp;         // name of the warp, as in the option --warp
    int slices = 1;           // number of partitions by depth
    int maps = 1;             // total number of maps
    double storageFactor = 0; // S: texels per pixel that bound the aliasing by 1
    double worstAcross = 0;   // max aliasing across the view direction (M_x) if each map had one texel per pixel
    double worstAlong = 0;
};

/// Returns the cost of all shadow map schemes with 1 to 8 slices. The view frustum has the depth range from `near` to
/// `far`, the full vertical angle `fovYDegrees` in degrees, and the ratio `aspect` of width to height. The components
/// of `towardsLight` point to the right, up and along the view.
GNOMON_API std::vector<ShadowScheme> shadowSchemes(
    double near, double far, double fovYDegrees, double aspect, const std::array<double, 3>& towardsLight);

} // namespace gnomon::api
