#include "preprocess/exporter/export.h"

#include "core/error.h"
#include "core/formatted.h"
#include "core/heap.h"
#include "hierarchy/cut_rule.h"
#include "hierarchy/model_file.h"
#include "preprocess/exporter/glb_writer.h"
#include "preprocess/exporter/ply_writer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

namespace gnomon::exporter {

using namespace hierarchy;

namespace {

/// The number of triangles that a uniform cut gains or loses when its error limit passes `error`.
struct Step {
    double error = 0;
    std::int64_t triangles = 0;

    bool operator<(const Step& other) const {
        return std::tie(error, triangles) < std::tie(other.error, other.triangles);
    }
};

/// Returns all changes of the number of triangles, in ascending order of the cut's error limit. A cluster is in the cut
/// if the limit is at least the cluster's stored error and below the error of its group.
std::vector<Step> stepsOf(const ModelFile& file, std::optional<Bytes> memory, Progress& progress) {
    std::vector<Step> steps;
    std::uint64_t count = 0;
    for (const PageInfo& info : file.pages())
        count += 2 * std::uint64_t{info.clusterCount};
    if (memory) requireRoom({count * sizeof(Step)}, *memory, file.path(), "counting the triangles of its cuts");
    steps.reserve(count);
    progress.stage("count", "pages", file.pages().size());
    for (std::uint32_t p = 0; p < file.pages().size(); ++p) {
        const Page page = file.readPage(p);
        for (const Group& group : page.groups)
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
                const Cluster& cluster = page.clusters[c];
                steps.push_back({drawnError(page, cluster, 0), cluster.triangleCount});
                steps.push_back({group.drawnError(), -static_cast<std::int64_t>(cluster.triangleCount)});
            }
        progress.advance(1);
    }
    std::sort(steps.begin(), steps.end());
    return steps;
}

/// Says which groups a uniform cut refines: all groups with a stored error above `error`, and the first groups whose
/// error is equal to `error`. Pages are sorted from coarse to fine. The parents of a group therefore come before it,
/// and the cut has no cracks.
struct CutLimit {
    double error = 0;
    GroupRef end{0, 0}; // groups with exactly the error `error` are refined if they come before `end`

    bool isRefined(double groupError, GroupRef group) const {
        return groupError > error || (groupError == error && group < end);
    }
};

/// Returns, for each group with the stored error `error`, how many triangles its refinement adds to the cut.
std::map<GroupRef, std::int64_t> growthAt(const ModelFile& file, double error, Progress& progress) {
    std::map<GroupRef, std::int64_t> growth;
    progress.stage("groups", "pages", file.pages().size());
    for (std::uint32_t p = 0; p < file.pages().size(); ++p) {
        const Page page = file.readPage(p);
        for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
            const Group& group = page.groups[g];
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
                const Cluster& cluster = page.clusters[c];
                const auto triangles = static_cast<std::int64_t>(cluster.triangleCount);
                if (group.drawnError() == error) growth[{p, g}] += triangles;
                if (cluster.refinement == kNone) continue;
                const Refinement& finer = page.refinements[cluster.refinement];
                if (finer.drawnError() == error) growth[finer.group] -= triangles;
            }
        }
        progress.advance(1);
    }
    return growth;
}

/// Refines groups whose stored error is equal to the limit, as long as the cut has at most `maxTriangles` triangles.
/// Many groups can have the same error. `triangles` is the number of triangles before the first of these refinements.
void refineGroups(
    const ModelFile& file, std::int64_t triangles, std::uint64_t maxTriangles, CutLimit& limit, Progress& progress) {
    std::int64_t best = triangles;
    for (const auto& [group, growth] : growthAt(file, limit.error, progress)) {
        triangles += growth;
        if (triangles <= best || static_cast<std::uint64_t>(triangles) > maxTriangles) continue;
        best = triangles;
        limit.end = {group.page, group.group + 1};
    }
}

/// Returns the finest uniform cut with at most `maxTriangles` triangles. It has the smallest possible error and refines
/// as many groups of exactly this error as possible.
CutLimit limitFor(const ModelFile& file, std::uint64_t maxTriangles, std::optional<Bytes> memory, Progress& progress) {
    const std::vector<Step> steps = stepsOf(file, memory, progress);
    std::int64_t triangles = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        triangles += steps[i].triangles;
        if (i + 1 < steps.size() && steps[i + 1].error == steps[i].error) continue;
        if (steps[i].error == std::numeric_limits<double>::infinity()) break;
        if (static_cast<std::uint64_t>(triangles) > maxTriangles) continue;
        CutLimit limit{steps[i].error, {0, 0}};
        refineGroups(file, triangles, maxTriangles, limit, progress);
        return limit;
    }
    throw Error(
        file.path(),
        "no level of detail has so few triangles",
        "at least " + std::to_string(file.summary().coarsestTriangles) + " triangles, those of the coarsest cut",
        std::to_string(maxTriangles));
}

/// Returns the limit of the coarsest uniform cut with an error of at most `error`. For an error of 0 the limit is
/// negative, so that all groups are refined.
CutLimit limitOf(const ModelFile& file, double error) {
    if (error == 0) return {-1, {0, 0}};
    const double minError = file.summary().grid.snapError();
    if (error >= minError) return {error, {0, 0}};
    throw Error(
        file.path(),
        "no level of detail is so accurate",
        formatted("an error of 0, or of at least %g, half a cell of the grid", minError),
        formatted("%g", error));
}

/// Calls `take(cluster)` for each cluster of `group` that the cut contains. The cut must refine `group`.
template <class Take>
void forEachDrawn(const Page& page, const Group& group, const CutLimit& limit, const Take& take) {
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
        const Cluster& cluster = page.clusters[c];
        if (cluster.refinement != kNone) {
            const Refinement& finer = page.refinements[cluster.refinement];
            if (limit.isRefined(finer.drawnError(), finer.group)) continue;
        }
        take(cluster);
    }
}

/// The numbers of vertices, triangles and clusters of a cut.
struct CutSize {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t clusters = 0;
};

/// Returns true if the cut refines no group of the page. The exporter then skips the page.
bool isSkipped(const PageInfo& info, const CutLimit& limit) {
    return info.maxError < limit.error;
}

/// Returns the total size of all pages with groups that the cut refines. The result is an upper bound of the size of
/// the cut.
CutSize sizeOfPages(const ModelFile& file, const CutLimit& limit) {
    CutSize size;
    for (const PageInfo& info : file.pages()) {
        if (isSkipped(info, limit)) continue;
        size.vertices += info.vertexCount;
        size.triangles += info.triangleCount;
        size.clusters += info.clusterCount;
    }
    return size;
}

/// Returns the exact size of the cut. The function reads all pages that the cut needs.
CutSize sizeOfCut(const ModelFile& file, const CutLimit& limit, Progress& progress) {
    CutSize size;
    progress.stage("measure", "pages", file.pages().size());
    for (std::uint32_t p = 0; p < file.pages().size(); ++p) {
        progress.advance(1);
        if (isSkipped(file.pages()[p], limit)) continue;
        const Page page = file.readPage(p);
        for (std::uint32_t g = 0; g < page.groups.size(); ++g) {
            if (!limit.isRefined(page.groups[g].drawnError(), {p, g})) continue;
            forEachDrawn(page, page.groups[g], limit, [&](const Cluster& cluster) {
                size.vertices += cluster.vertexCount;
                size.triangles += cluster.triangleCount;
                ++size.clusters;
            });
        }
    }
    return size;
}

/// Returns the memory in bytes for collecting, welding and writing a cut of size `size`. Writing needs `writingBytes`
/// bytes per vertex.
std::uint64_t bytesOf(const CutSize& size, const ModelSummary& summary, std::uint64_t writingBytes) {
    constexpr std::uint64_t kOther = std::uint64_t{16} << 20U; // bytes of a decoded page and of output buffers
    // Welding needs 12 bytes per vertex: its position in the order, the first equal vertex, and its new index.
    constexpr std::uint64_t kWeldBytes = 12;
    const std::uint64_t ofVertex =
        sizeof(Vertex) + (summary.fields.empty() ? 0 : sizeof(std::uint32_t)) + std::max(kWeldBytes, writingBytes);
    return kOther + size.vertices * ofVertex + size.triangles * sizeof(CutMesh{}.triangles[0]) +
           size.clusters * sizeof(CutCluster);
}

/// The memory limits for exporting a cut.
struct CutRoom {
    std::optional<Bytes> memory;    // max memory of the process; nullopt means no limit
    std::uint64_t writingBytes = 0; // bytes per vertex that the file writer needs
};

/// Returns an upper bound of the size of the cut. Throws Error if the cut does not fit into the memory limit.
CutSize affordableSize(const ModelFile& file, const CutLimit& limit, const CutRoom& room, Progress& progress) {
    const CutSize ofPages = sizeOfPages(file, limit);
    const auto bytes = [&](const CutSize& size) { return bytesOf(size, file.summary(), room.writingBytes); };
    if (!room.memory || residentSize().count + bytes(ofPages) <= room.memory->count) return ofPages;
    const CutSize exact = sizeOfCut(file, limit, progress);
    requireRoom({bytes(exact)}, *room.memory, file.path(), "this cut");
    return exact;
}

UniformCut collect(const ModelFile& file, const CutLimit& limit, const CutRoom& room, Progress& progress) {
    UniformCut cut;
    PageFields fields;
    const CutSize size = affordableSize(file, limit, room, progress);
    cut.mesh.vertices.reserve(size.vertices);
    cut.mesh.triangles.reserve(size.triangles);
    if (!file.summary().fields.empty()) cut.mesh.fields.words.reserve(size.vertices);
    cut.clusters.reserve(size.clusters);
    progress.stage("cut", "pages", file.pages().size());
    for (std::uint32_t p = 0; p < file.pages().size(); ++p) {
        progress.advance(1);
        if (isSkipped(file.pages()[p], limit)) continue;
        const Page page = file.readPage(p, fields);
        cut.mesh.fields.layout = fields.layout;
        for (std::uint32_t g = 0; g < page.groups.size(); ++g)
            if (limit.isRefined(page.groups[g].drawnError(), {p, g}))
                forEachDrawn(page, page.groups[g], limit, [&](const Cluster& cluster) {
                    addCluster(page, fields, cluster, file.summary().grid.snapError(), cut);
                });
        if (cut.mesh.vertices.size() > std::numeric_limits<std::int32_t>::max())
            throw Error(file.path(), "the cut has more vertices than a PLY can number");
    }
    return cut;
}

/// Returns the vertex indices in an order in which equal vertices are adjacent. Among equal vertices the smallest index
/// comes first.
std::vector<std::uint32_t> sortedVertices(const CutMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&mesh](std::uint32_t a, std::uint32_t b) {
        if (mesh.vertices[a] != mesh.vertices[b]) return mesh.vertices[a] < mesh.vertices[b];
        return mesh.fieldsOf(a) != mesh.fieldsOf(b) ? mesh.fieldsOf(a) < mesh.fieldsOf(b) : a < b;
    });
    return order;
}

} // namespace

void addCluster(const Page& page, const PageFields& fields, const Cluster& cluster, double snapError, UniformCut& cut) {
    cut.error = std::max(cut.error, storedError(page, cluster, snapError));
    const auto first = static_cast<std::uint32_t>(cut.mesh.vertices.size());
    cut.clusters.push_back(
        {first, cluster.vertexCount, static_cast<std::uint32_t>(cut.mesh.triangles.size()), cluster.triangleCount});
    const auto begin = page.vertices.begin() + cluster.firstVertex;
    cut.mesh.vertices.insert(cut.mesh.vertices.end(), begin, begin + cluster.vertexCount);
    for (std::uint32_t v = 0; v < cluster.vertexCount && !fields.words.empty(); ++v)
        cut.mesh.fields.words.push_back(fields.words[cluster.firstVertex + v]);
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        const Triangle& triangle = page.triangles[cluster.firstTriangle + t];
        cut.mesh.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
    }
}

void weld(CutMesh& mesh) {
    const std::vector<std::uint32_t> order = sortedVertices(mesh);
    std::vector<std::uint32_t> first(order.size()); // smallest index of an equal vertex, per vertex
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool isNew = i == 0 || mesh.vertices[order[i]] != mesh.vertices[order[i - 1]] ||
                           mesh.fieldsOf(order[i]) != mesh.fieldsOf(order[i - 1]);
        first[order[i]] = isNew ? order[i] : first[order[i - 1]];
    }
    std::uint32_t next = 0;
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t v = 0; v < first.size(); ++v) {
        if (first[v] == v) mesh.vertices[next] = mesh.vertices[v];
        if (first[v] == v && !mesh.fields.words.empty()) mesh.fields.words[next] = mesh.fields.words[v];
        place[v] = first[v] == v ? next++ : place[first[v]];
    }
    mesh.vertices.resize(next);
    if (!mesh.fields.words.empty()) mesh.fields.words.resize(next);
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle)
            corner = place[corner];
}

namespace {

UniformCut cutOf(const ModelFile& file, const ExportLimit& limit, std::uint64_t writingBytes, Progress& progress) {
    const CutLimit refined =
        limit.triangles ? limitFor(file, *limit.triangles, limit.memory, progress) : limitOf(file, *limit.error);
    return collect(file, refined, {limit.memory, writingBytes}, progress);
}

} // namespace

UniformCut uniformCut(const ModelFile& file, const ExportLimit& limit, Progress& progress) {
    return cutOf(file, limit, 0, progress);
}

std::string cutText(const ExportedCut& cut) {
    return formatted(
        "%llu triangles, %llu vertices, error at most %g",
        static_cast<unsigned long long>(cut.triangles),
        static_cast<unsigned long long>(cut.vertices),
        cut.error);
}

ExportedCut exportCut(
    const std::string& model,
    const ExportLimit& limit,
    const std::string& output,
    Progress& progress,
    ExportFormat format) {
    const ModelFile file(model);
    UniformCut cut = cutOf(file, limit, file.summary().hasNormals ? sizeof(glm::dvec3) : 0, progress);
    weld(cut.mesh);
    if (format == ExportFormat::Glb)
        writeGlb(cut.mesh, file.summary(), output, progress);
    else
        writePly(cut.mesh, file.summary(), {}, output, progress);
    return {cut.error, cut.mesh.triangles.size(), cut.mesh.vertices.size()};
}

} // namespace gnomon::exporter
