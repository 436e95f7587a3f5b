#include "preprocess/chunk/binning.h"

#include "core/check.h"
#include "core/limit_error.h"
#include "hierarchy/octahedral.h"
#include "preprocess/chunk/field_numbers.h"
#include "preprocess/chunk/heavy_points.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "preprocess/read/polygon.h"

#include <algorithm>
#include <optional>

namespace gnomon::chunk {

namespace {

using Corners = std::array<std::uint32_t, 3>;

Corners narrow(const read::TriangleCorners& t) {
    return {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2])};
}

/// Without a store it counts what it would write.
class Binner {
public:
    Binner(
        read::MeshSource& source,
        const SourceSurvey& survey,
        scratch::StreamStore* bins,
        const ChunkTree& tree,
        std::size_t polygonCorners,
        Progress& progress)
        : source_(source),
          fields_(survey.fields),
          bins_(bins),
          format_(formatOf(source.summary())),
          polygonCorners_(polygonCorners),
          progress_(progress),
          tree_(tree),
          heavy_(tree.heavyPoints(), (kMaxChunks - tree.chunkCount()) / 2),
          isHeavy_(tree.chunkCount()),
          placeOf_(source.summary().vertexCount),
          sizes_(tree.chunkCount()),
          polygons_(streamOf(SourceStream::Polygons, tree.chunkCount())),
          triangles_(streamOf(SourceStream::Triangles, tree.chunkCount())) {
        for (std::size_t i = 0; i < heavy_.size(); ++i) {
            heavyChunks_.push_back(static_cast<std::uint16_t>(tree.chunkOf(heavy_[i])));
            isHeavy_[heavyChunks_.back()] = true;
        }
        if (heavy_.size() > 0) isNeeded_.resize(placeOf_.size());
    }

    /// All that triangles use but those in chunks with heavy points.
    void binVertices(const SourceSurvey& survey) {
        progress_.stage("bin", "vertices", source_.summary().vertexCount);
        const GridSnap snap(survey.grid);
        source_.readVertices([&](const read::VertexBlock& block) {
            for (std::size_t i = 0; i < block.positions.size(); ++i) {
                const std::uint64_t vertex = block.firstVertex + i;
                if (survey.valence[vertex] == 0) continue;
                const hierarchy::GridPoint point = snap(block.positions[i]);
                const auto chunk = static_cast<std::uint16_t>(tree_.chunkOf(point));
                placeOf_[vertex] = chunk;
                if (!isHeavy_[chunk]) {
                    write(block, i, chunk);
                } else if (const auto found = heavy_.find(point, block.positions[i])) {
                    placeOf_[vertex] = static_cast<std::uint16_t>(tree_.chunkCount() + *found);
                } else {
                    isNeeded_[vertex] = true;
                }
            }
            progress_.advance(block.positions.size());
        });
        flush();
    }

    /// Those in chunks with heavy points, once all triangles are in chunks.
    void binHeavyVertices() {
        if (heavy_.size() == 0) return;
        progress_.stage("bin", "vertices", source_.summary().vertexCount);
        source_.readVertices([&](const read::VertexBlock& block) {
            for (std::size_t i = 0; i < block.positions.size(); ++i)
                if (isNeeded_[block.firstVertex + i])
                    write(block, i, chunkOf(static_cast<std::uint32_t>(block.firstVertex + i)));
            progress_.advance(block.positions.size());
        });
        flush();
    }

    /// Triangulates the polygons that lie in several chunks, so that `binTriangles` finds them ready.
    void refinePolygons() {
        progress_.stage("polygons", "faces", source_.summary().faceCount);
        source_.readTriangles([&](const read::TriangleBlock& block) {
            for (const read::PolygonRun& run : block.polygons) {
                const auto fan = block.triangles.subspan(run.first, run.count);
                if (isInOneChunk(fan)) continue;
                put(polygons_, run.count);
                for (const read::TriangleCorners& t : fan)
                    put(polygons_, t);
            }
            progress_.advance(block.faceCount());
        });
        flush();
        scratch::StreamStore::Reader reader(*bins_, polygons_);
        while (!reader.isAtEnd())
            refineSome(reader);
        flush();
        bins_->release(polygons_);
    }

    void binTriangles() {
        progress_.stage("bin", "faces", source_.summary().faceCount);
        std::optional<scratch::StreamStore::Reader> refined;
        if (bins_ != nullptr) refined.emplace(*bins_, triangles_);
        source_.readTriangles([&](const read::TriangleBlock& block) {
            auto run = block.polygons.begin();
            for (std::size_t i = 0; i < block.triangles.size();) {
                if (run == block.polygons.end() || run->first > i) {
                    add(narrow(block.triangles[i++]));
                    continue;
                }
                const auto fan = block.triangles.subspan(run->first, run->count);
                if (isInOneChunk(fan)) {
                    addFan(fan);
                } else if (!refined) {
                    countInAllItsChunks(fan);
                } else {
                    for (std::size_t k = 0; k < fan.size(); ++k)
                        add(refinedTriangle(*refined));
                }
                i += run->count;
                ++run;
            }
            progress_.advance(block.faceCount());
        });
        if (bins_ == nullptr) return;
        if (!refined->isAtEnd()) throwOtherPolygons();
        bins_->flush();
        bins_->release(triangles_);
    }

    BinnedSize size() const {
        BinnedSize size;
        for (const PartSize& chunk : sizes_)
            size.largestChunk.growTo(chunk);
        size.dropped = dropped_;
        return size;
    }

private:
    std::uint16_t chunkOf(std::uint32_t vertex) const {
        const std::uint16_t place = placeOf_[vertex];
        return place < sizes_.size() ? place : heavyChunks_[(place - sizes_.size()) / 2];
    }

    template <class T>
    void put(std::uint32_t stream, const T& value) {
        if (bins_ != nullptr) bins_->put(stream, value);
    }

    void flush() {
        if (bins_ != nullptr) bins_->flush();
    }

    /// Writes vertex `i` of a block to its chunk.
    void write(const read::VertexBlock& block, std::size_t i, std::uint16_t chunk) {
        ++sizes_[chunk].vertices;
        if (bins_ == nullptr) return;
        ChunkVertex vertex;
        vertex.index = static_cast<std::uint32_t>(block.firstVertex + i);
        vertex.position = block.positions[i];
        if (!block.normals.empty()) vertex.normal = hierarchy::packNormal(glm::dvec3(block.normals[i]));
        if (!block.colors.empty()) vertex.color = block.colors[i];
        if (!fields_.empty())
            vertex.fields = packedFields(block.fields.subspan(i * fields_.size(), fields_.size()), fields_);
        VertexBytes storage{};
        bins_->append(streamOf(BinStream::Vertices, chunk), encodeVertex(vertex, format_, storage));
    }

    /// Whether the triangle lies between heavy points and repeats another there, for which it is dropped.
    bool isDropped(const Corners& corners) {
        std::array<std::uint32_t, 3> found{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t place = placeOf_[corners[i]];
            if (place < sizes_.size()) return false;
            found[i] = static_cast<std::uint32_t>(place - sizes_.size());
        }
        return heavy_.isRepeated(corners, found, dropped_);
    }

    void markNeeded(const Corners& corners) {
        if (isNeeded_.empty()) return;
        for (const std::uint32_t corner : corners)
            if (placeOf_[corner] >= sizes_.size()) isNeeded_[corner] = true;
    }

    /// As many polygons as fit at once: one pass over the vertices.
    void refineSome(scratch::StreamStore::Reader& reader) {
        std::vector<read::TriangleCorners> fans;
        std::vector<std::uint32_t> sizes;
        std::vector<std::uint32_t> corners;
        while (!reader.isAtEnd() && corners.size() < polygonCorners_) {
            sizes.push_back(reader.take<std::uint32_t>());
            for (std::uint32_t i = 0; i < sizes.back(); ++i) {
                fans.push_back(reader.take<read::TriangleCorners>());
                for (const std::uint32_t corner : narrow(fans.back()))
                    corners.push_back(corner);
            }
        }
        const VertexLookup positions(source_, std::move(corners));
        read::PolygonRefiner refiner(progress_);
        std::size_t begin = 0;
        for (const std::uint32_t size : sizes) {
            refiner.refine(std::span(fans).subspan(begin, size), [&](std::uint64_t vertex) {
                return positions[static_cast<std::uint32_t>(vertex)];
            });
            begin += size;
        }
        for (const read::TriangleCorners& t : fans)
            put(triangles_, narrow(t));
    }

    Corners refinedTriangle(scratch::StreamStore::Reader& refined) const {
        if (refined.isAtEnd()) throwOtherPolygons();
        return refined.take<Corners>();
    }

    /// Of two passes that found different ones.
    [[noreturn]] void throwOtherPolygons() const {
        source_.requireUnchanged();
        throw Error(source_.summary().path, "the input changed while it was read");
    }

    bool isInOneChunk(std::span<const read::TriangleCorners> fan) const {
        const std::uint16_t chunk = chunkOf(narrow(fan.front())[0]);
        return std::all_of(fan.begin(), fan.end(), [&](const read::TriangleCorners& t) {
            const Corners corners = narrow(t);
            return std::all_of(
                corners.begin(), corners.end(), [&](std::uint32_t corner) { return chunkOf(corner) == chunk; });
        });
    }

    void addFan(std::span<const read::TriangleCorners> fan) {
        const std::uint16_t chunk = chunkOf(narrow(fan.front())[0]);
        const std::uint32_t stream = streamOf(BinStream::Triangles, chunk);
        sizes_[chunk].triangles += fan.size();
        put(stream, Corners{kPolygonMark, static_cast<std::uint32_t>(fan.size()), 0});
        for (const read::TriangleCorners& t : fan) {
            put(stream, narrow(t));
            markNeeded(narrow(t));
        }
    }

    /// Of a polygon that is not triangulated rightly yet: whichever triangles each of its chunks gets, it is no more.
    void countInAllItsChunks(std::span<const read::TriangleCorners> fan) {
        std::vector<std::uint16_t> chunks;
        for (const read::TriangleCorners& t : fan) {
            markNeeded(narrow(t));
            for (const std::uint32_t corner : narrow(t))
                chunks.push_back(chunkOf(corner));
        }
        std::sort(chunks.begin(), chunks.end());
        chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
        for (const std::uint16_t chunk : chunks) {
            sizes_[chunk].triangles += fan.size();
            sizes_[chunk].vertices += 2 * fan.size();
        }
    }

    void add(const Corners& corners) {
        if (isDropped(corners)) return;
        markNeeded(corners);
        const std::array<std::uint16_t, 3> lies{chunkOf(corners[0]), chunkOf(corners[1]), chunkOf(corners[2])};
        const std::uint16_t owner =
            std::max(std::min(lies[0], lies[1]), std::min(std::max(lies[0], lies[1]), lies[2])); // the median
        put(streamOf(BinStream::Triangles, owner), corners);
        ++sizes_[owner].triangles;
        if (lies[0] == lies[1] && lies[1] == lies[2]) return;
        request(corners, lies, owner, true);
        if (format_.hasNormals) return;
        for (std::size_t i = 0; i < 3; ++i) {
            const bool isFirst = std::find(lies.begin(), lies.begin() + static_cast<std::ptrdiff_t>(i), lies[i]) ==
                                 lies.begin() + static_cast<std::ptrdiff_t>(i);
            if (lies[i] == owner || !isFirst) continue;
            put(streamOf(BinStream::Ghosts, lies[i]), corners);
            ++sizes_[lies[i]].triangles;
            request(corners, lies, lies[i], false);
        }
    }

    /// Asks for the corners that do not lie in `chunk`.
    void request(const Corners& corners, const std::array<std::uint16_t, 3>& lies, std::uint16_t chunk, bool isOwner) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (lies[i] == chunk) continue;
            put(streamOf(BinStream::Requests, lies[i]), VertexRequest{chunk, corners[i], isOwner ? 1U : 0U});
            ++sizes_[chunk].vertices; // once for each of its triangles there: more than they are
        }
    }

    read::MeshSource& source_;
    const std::vector<hierarchy::Field>& fields_;
    scratch::StreamStore* bins_; // none where it only counts
    VertexFormat format_;
    std::size_t polygonCorners_;
    Progress& progress_;
    const ChunkTree& tree_;
    HeavyPoints heavy_;
    std::vector<std::uint16_t> heavyChunks_; // in which the heavy points lie
    std::vector<bool> isHeavy_;              // whether a chunk has a heavy point
    std::vector<std::uint16_t> placeOf_;     // a vertex's chunk, or behind the chunks what HeavyPoints::find tells
    std::vector<bool> isNeeded_; // the vertices to write of chunks with heavy points; empty if there are none
    DroppedTriangles dropped_;
    std::vector<PartSize> sizes_; // of the chunks
    std::uint32_t polygons_;      // streams of the whole source
    std::uint32_t triangles_;
};

} // namespace

VertexFormat formatOf(const read::MeshSummary& source) {
    return {source.isDouble, source.hasNormals, source.hasColors, hierarchy::FieldLayout::of(source.fields.size())};
}

ChunkTree planChunks(
    read::MeshSource& source, const SourceSurvey& survey, std::uint32_t chunkTriangles, Progress& progress) {
    const std::uint64_t limit = std::uint64_t{3} * chunkTriangles;
    const GridSnap snap(survey.grid);
    CellCounts counts(survey.furthest);
    do {
        progress.stage("octree", "vertices", survey.vertices);
        source.readVertices([&](const read::VertexBlock& block) {
            for (std::size_t i = 0; i < block.positions.size(); ++i)
                if (const std::uint8_t valence = survey.valence[block.firstVertex + i]; valence > 0)
                    counts.add(snap(block.positions[i]), valence);
            progress.advance(block.positions.size());
        });
    } while (counts.refine(limit / 8));
    ChunkTree tree(counts, limit);
    if (tree.chunkCount() > kMaxChunks)
        throw LimitError(
            Limit::ChunkTriangles,
            {source.summary().path,
             "chunks of too few triangles for this model",
             "at most " + std::to_string(kMaxChunks) + " chunks",
             std::to_string(tree.chunkCount())});
    return tree;
}

BinnedSize binSource(
    read::MeshSource& source,
    SourceSurvey& survey,
    const ChunkTree& tree,
    scratch::StreamStore& bins,
    std::size_t polygonCorners,
    Progress& progress) {
    Binner binner(source, survey, &bins, tree, polygonCorners, progress);
    binner.binVertices(survey);
    survey.valence = {};
    if (survey.hasPolygons) binner.refinePolygons();
    binner.binTriangles();
    binner.binHeavyVertices();
    return binner.size();
}

BinnedSize measureBins(
    read::MeshSource& source, const SourceSurvey& survey, const ChunkTree& tree, Progress& progress) {
    Binner binner(source, survey, nullptr, tree, 0, progress);
    binner.binVertices(survey);
    binner.binTriangles();
    binner.binHeavyVertices();
    return binner.size();
}

} // namespace gnomon::chunk
