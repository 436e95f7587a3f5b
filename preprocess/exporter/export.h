// `gnomon export`: one uniform cut of a model as a PLY or a glTF.
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

enum class ExportFormat { Ply, Glb };

/// What to cut at: exactly one of `triangles` and `error`.
struct ExportLimit {
    std::optional<std::uint64_t> triangles; // at most
    std::optional<double> error;            // at most, world units; 0: full detail
    std::optional<Bytes> memory = {};       // max resident size of the process; nothing: no limit
};

/// Which vertices and triangles of a cut are a cluster's.
struct CutCluster {
    std::uint32_t firstVertex = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
};

/// A cut in memory, cluster by cluster; vertices on borders are there once for each cluster.
struct UniformCut {
    CutMesh mesh;
    std::vector<CutCluster> clusters;
    double error = 0; // the largest stored error in it, world units
};

/// Appends `cluster` of `page` to `cut`; `fields` are those of the page's vertices, or none.
void addCluster(
    const hierarchy::Page& page,
    const hierarchy::PageFields& fields,
    const hierarchy::Cluster& cluster,
    double snapError,
    UniformCut& cut);

/// The cut that `limit` asks for, as exportCut has it. Throws Error as exportCut does.
UniformCut uniformCut(const hierarchy::ModelFile& file, const ExportLimit& limit, Progress& progress);

/// Makes vertices with the same position, normal, colour and fields one, in the order of their first use.
void weld(CutMesh& mesh);

struct ExportedCut {
    double error = 0; // the largest stored error in it, world units
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
};

/// One line for people.
std::string cutText(const ExportedCut& cut);

/// Writes the finest uniform cut of `model` with at most `limit.triangles`, or the coarsest whose error is at most
/// `limit.error`, to `output`. Corners with the same position, normal, colour and fields are one vertex. Holds the cut
/// in memory. Throws Error if no cut is that small or that exact, if a page is damaged, or if the cut does not fit into
/// `limit.memory`; that error names the memory that does.
ExportedCut exportCut(
    const std::string& model,
    const ExportLimit& limit,
    const std::string& output,
    Progress& progress,
    ExportFormat format = ExportFormat::Ply);

} // namespace gnomon::exporter
