// Implements `gnomon export`: writes a uniform cut of a model as a PLY or glTF file.
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

/// The limit of a cut. The caller sets exactly one of `triangles` and `error`.
struct ExportLimit {
    std::optional<std::uint64_t> triangles; // max number of triangles
    std::optional<double> error;            // max error in world units; 0: full detail
    std::optional<Bytes> memory = {};       // max resident size of the process; nullopt: no limit
};

/// The vertices and triangles of one cluster in a cut.
struct CutCluster {
    std::uint32_t firstVertex = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
};

/// A cut in memory as a list of clusters. Vertices on borders between clusters exist once per cluster.
struct UniformCut {
    CutMesh mesh;
    std::vector<CutCluster> clusters;
    double error = 0; // largest stored error of its clusters in world units
};

/// Appends `cluster` of `page` to `cut`. `fields` contains the fields of the page's vertices. It can be empty.
void addCluster(
    const hierarchy::Page& page,
    const hierarchy::PageFields& fields,
    const hierarchy::Cluster& cluster,
    double snapError,
    UniformCut& cut);

/// Returns the uniform cut for `limit`. The choice of the cut and the errors are as for exportCut.
UniformCut uniformCut(const hierarchy::ModelFile& file, const ExportLimit& limit, Progress& progress);

/// Merges vertices with equal position, normal, colour and fields. The remaining vertices are in the order of their
/// first use.
void weld(CutMesh& mesh);

/// The size and error of an exported cut.
struct ExportedCut {
    double error = 0; // largest stored error of its clusters in world units
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
};

/// Returns a description of the exported cut in one line.
std::string cutText(const ExportedCut& cut);

/// Writes a uniform cut of `model` to `output`. This is the finest cut with at most `limit.triangles` triangles, or the
/// coarsest cut with an error of at most `limit.error`. Corners with equal position, normal, colour and fields become
/// one vertex. The whole cut is in memory. Throws Error if no cut satisfies the limit, if a page is damaged, or if the
/// cut does not fit into `limit.memory`. In the last case the message names the required memory.
ExportedCut exportCut(
    const std::string& model,
    const ExportLimit& limit,
    const std::string& output,
    Progress& progress,
    ExportFormat format = ExportFormat::Ply);

} // namespace gnomon::exporter
