// The command `gnomon export`: writes a uniform cut of a model as a PLY or glTF file.
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

/// The limit of a cut: exactly one of `triangles` and `error`.
struct ExportLimit {
    std::optional<std::uint64_t> triangles; // max number of triangles
    std::optional<double> error;            // max error in world units; 0: full detail
    std::optional<Bytes> memory = {};       // max resident size of the process; nothing: no limit
};

/// The range of vertices and triangles of a cluster in a cut.
struct CutCluster {
    std::uint32_t firstVertex = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
};

/// A cut in memory, cluster by cluster. Vertices on borders between clusters exist once per cluster.
struct UniformCut {
    CutMesh mesh;
    std::vector<CutCluster> clusters;
    double error = 0; // largest stored error in world units
};

/// Appends `cluster` of `page` to `cut`. `fields` are the fields of the page's vertices, or empty.
void addCluster(
    const hierarchy::Page& page,
    const hierarchy::PageFields& fields,
    const hierarchy::Cluster& cluster,
    double snapError,
    UniformCut& cut);

/// Returns the cut for `limit`, with the rules and errors of exportCut.
UniformCut uniformCut(const hierarchy::ModelFile& file, const ExportLimit& limit, Progress& progress);

/// Merges vertices with equal position, normal, colour and fields, in the order of first use.
void weld(CutMesh& mesh);

/// The size and error of an exported cut.
struct ExportedCut {
    double error = 0; // largest stored error in world units
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
};

/// Returns a description of one line.
std::string cutText(const ExportedCut& cut);

/// Writes the finest uniform cut of `model` with at most `limit.triangles` triangles, or the coarsest cut with an error
/// of at most `limit.error`, to `output`. Corners with equal position, normal, colour and fields become one vertex. The
/// cut is in memory. Throws Error if no cut satisfies the limit, if a page is damaged, or if the cut does not fit into
/// `limit.memory`. The last message names the required memory.
ExportedCut exportCut(
    const std::string& model,
    const ExportLimit& limit,
    const std::string& output,
    Progress& progress,
    ExportFormat format = ExportFormat::Ply);

} // namespace gnomon::exporter
