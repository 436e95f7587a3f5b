// Implements `gnomon export`: writes one level of detail of a model (a uniform cut) as a PLY or glTF file.
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "hierarchy/model_file.h"
#include "preprocess/exporter/cut_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::exporter {

/// The file format of an exported cut.
enum class ExportFormat { Ply, Glb };

/// Limits the size or the error of an exported cut. The caller sets exactly one of `triangles` and `error`.
struct ExportLimit {
    std::optional<std::uint64_t> triangles; // max number of triangles
    std::optional<double> error;            // max error in world units; 0 means full detail
    std::optional<Bytes> memory = {};       // max resident size of the process; nullopt means no limit
};

/// The vertices and triangles of one cluster in a UniformCut.
struct CutCluster {
    std::uint32_t firstVertex = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
};

/// A uniform cut of a model in memory, as a list of clusters. Each cluster has its own copy of the vertices on its
/// border.
struct UniformCut {
    CutMesh mesh;
    std::vector<CutCluster> clusters;
    double error = 0; // largest stored error of the cut's clusters, in world units
};

/// Appends the vertices and triangles of `cluster` of `page` to `cut`. `fields` contains the scalar fields of the
/// page's vertices and can be empty.
void addCluster(
    const hierarchy::Page& page,
    const hierarchy::PageFields& fields,
    const hierarchy::Cluster& cluster,
    double snapError,
    UniformCut& cut);

/// Returns the uniform cut that exportCut would write for `limit`, with the same errors.
UniformCut uniformCut(const hierarchy::ModelFile& file, const ExportLimit& limit, Progress& progress);

/// Merges vertices with equal position, normal, colour and fields. The remaining vertices are in the order of their
/// first use.
void weld(CutMesh& mesh);

/// The size and the error of a cut that was exported.
struct ExportedCut {
    double error = 0; // largest stored error of the cut's clusters, in world units
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
};

/// Returns a description of the exported cut in one line, for the user.
std::string cutText(const ExportedCut& cut);

/// Writes a uniform cut of `model` to the file `output`. The cut is the finest cut with at most `limit.triangles`
/// triangles, or the coarsest cut with an error of at most `limit.error`. Corners with equal position, normal, colour
/// and fields become one vertex. The whole cut is in memory. Throws Error if no cut satisfies the limit, if a page is
/// damaged, or if the cut does not fit into `limit.memory`. In the last case the message names the required memory.
ExportedCut exportCut(
    const std::string& model,
    const ExportLimit& limit,
    const std::string& output,
    Progress& progress,
    ExportFormat format = ExportFormat::Ply);

} // namespace gnomon::exporter
