#include "preprocess/chunk/binning.h"

#include "core/check.h"
#include "core/limit_error.h"
#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/heavy_points.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "preprocess/read/polygon.h"

#include <algorithm>
#include <optional>

namespace gnomon::chunk {

namespace {

using Corners = read::TriangleCorners;

/// Returns the max number of heavy points (grid points with very many triangles) that a VertexNumbers table can
/// distinguish. With this limit the table needs 16 bits per vertex if the chunk numbers alone need at most 16 bits.
std::size_t maxHeavyPoints(std::uint32_t chunks) {
    return chunks <= kNarrowChunks ? (kNarrowChunks - chunks) / 2 : kNarrowChunks / 2;
}

/// Writes the vertices and triangles of a source into the streams of their chunks. Without a stream store it only
/// counts them.
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
          bins_(bins),
          writer_(formatOf(source.summary()), survey.fields, bins, tree.chunkCount()),
          polygonCorners_(polygonCorners),
          progress_(progress),
          tree_(tree),
          heavy_(tree.heavyPoints(), maxHeavyPoints(tree.chunkCount())),
          isHeavy_(tree.chunkCount()),
          placeOf_(source.summary().vertexCount, tree.chunkCount() + 2 * heavy_.size()),
          polygons_(streamOf(SourceStream::Polygons, tree.chunkCount())),
          triangles_(streamOf(SourceStream::Triangles, tree.chunkCount())) {
        for (std::size_t i = 0; i < heavy_.size(); ++i) {
            heavyChunks_.push_back(tree.chunkOf(heavy_[i]));
            isHeavy_[heavyChunks_.back()] = true;
        }
        heavyChunks_.push_back(kOutsideGrid);
        if (heavy_.size() > 0) isNeeded_.resize(source.summary().vertexCount);
    }

    /// Writes the vertices of triangles to their chunks, except the vertices at heavy points (grid points with very
    /// many triangles).
    void binVertices(const SourceSurvey& survey) {
        progress_.stage("bin", "vertices", source_.summary().vertexCount);
        const GridSnap snap(survey.grid);
        source_.readVertices([&](const read::VertexBlock& block) {
            for (std::size_t i = 0; i < block.positions.size(); ++i) {
                const std::uint64_t vertex = block.firstVertex + i;
                if (survey.valence[vertex] == 0) continue;
                if (!snap.isInRange(block.positions[i])) {
                    strays_.add(block.positions[i]);
                    placeOf_.set(vertex, outsideGrid());
                    continue;
                }
                const hierarchy::GridPoint point = snap(block.positions[i]);
                const std::uint32_t chunk = tree_.chunkOf(point);
                placeOf_.set(vertex, chunk);
                if (!isHeavy_[chunk]) {
                    writer_.putVertex(block, i, chunk);
                } else if (const auto found = heavy_.find(point, block.positions[i])) {
                    placeOf_.set(vertex, tree_.chunkCount() + *found);
                } else {
                    isNeeded_[vertex] = true;
                }
            }
            progress_.advance(block.positions.size());
        });
        flush();
    }

    /// Writes the vertices at heavy points (grid points with very many triangles) that a triangle uses. All triangles
    /// must already be in chunks.
    void binHeavyVertices() {
        if (heavy_.size() == 0) return;
        progress_.stage("bin", "vertices", source_.summary().vertexCount);
        source_.readVertices([&](const read::VertexBlock& block) {
            for (std::size_t i = 0; i < block.positions.size(); ++i)
                if (isNeeded_[block.firstVertex + i]) writer_.putVertex(block, i, chunkOf(block.firstVertex + i));
            progress_.advance(block.positions.size());
        });
        flush();
    }

    /// Triangulates the polygons whose corners lie in several chunks. `binTriangles` later reads the resulting
    /// triangles.
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
            block.forEachFace([&](std::span<const Corners> face) {
                if (face.size() == 1) {
                    add(face.front());
                } else if (isInOneChunk(face)) {
                    addFan(face);
                } else if (!refined) {
                    countInAllItsChunks(face);
                } else {
                    for (std::size_t k = 0; k < face.size(); ++k)
                        add(refinedTriangle(*refined));
                }
            });
            progress_.advance(block.faceCount());
        });
        if (bins_ == nullptr) return;
        if (!refined->isAtEnd()) throwOtherPolygons();
        bins_->flush();
        bins_->release(triangles_);
    }

    BinnedSize size() const {
        BinnedSize size;
        for (const PartSize& chunk : writer_.sizes())
            size.largestChunk.growTo(chunk);
        size.dropped = dropped_;
        size.strayed = {writer_.outsideGrid(), strays_};
        return size;
    }

private:
    std::uint32_t chunkOf(std::uint64_t vertex) const {
        const std::uint32_t place = placeOf_[vertex];
        return place < tree_.chunkCount() ? place : heavyChunks_[(place - tree_.chunkCount()) / 2];
    }

    /// Returns the number that `placeOf_` contains for a vertex outside the range of the grid.
    std::uint32_t outsideGrid() const { return tree_.chunkCount() + static_cast<std::uint32_t>(2 * heavy_.size()); }

    template <class T>
    void put(std::uint32_t stream, const T& value) {
        if (bins_ != nullptr) bins_->put(stream, value);
    }

    void flush() {
        if (bins_ != nullptr) bins_->flush();
    }

    /// Returns true if all corners of a triangle lie at heavy points and the triangle repeats an earlier triangle.
    /// `binTriangles` drops such a triangle.
    bool isDropped(const Corners& corners) {
        std::array<std::uint32_t, 3> found{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t place = placeOf_[corners[i]];
            if (place < tree_.chunkCount() || place == outsideGrid()) return false;
            found[i] = place - tree_.chunkCount();
        }
        return heavy_.isRepeated(corners, found, dropped_);
    }

    void markNeeded(const Corners& corners) {
        if (isNeeded_.empty()) return;
        for (const std::uint64_t corner : corners)
            if (const std::uint32_t place = placeOf_[corner]; place >= tree_.chunkCount() && place != outsideGrid())
                isNeeded_[corner] = true;
    }

    /// Triangulates as many of the next polygons of `reader` as fit in memory. Makes one pass over the vertices of the
    /// source.
    void refineSome(scratch::StreamStore::Reader& reader) {
        std::vector<read::TriangleCorners> fans;
        std::vector<std::uint32_t> sizes;
        std::vector<std::uint64_t> corners;
        while (!reader.isAtEnd() && corners.size() < polygonCorners_) {
            sizes.push_back(reader.take<std::uint32_t>());
            for (std::uint32_t i = 0; i < sizes.back(); ++i) {
                fans.push_back(reader.take<read::TriangleCorners>());
                corners.insert(corners.end(), fans.back().begin(), fans.back().end());
            }
        }
        const VertexLookup positions(source_, std::move(corners));
        read::PolygonRefiner refiner(progress_);
        std::size_t begin = 0;
        for (const std::uint32_t size : sizes) {
            refiner.refine(
                std::span(fans).subspan(begin, size), [&](std::uint64_t vertex) { return positions[vertex]; });
            begin += size;
        }
        for (const read::TriangleCorners& t : fans)
            put(triangles_, t);
    }

    Corners refinedTriangle(scratch::StreamStore::Reader& refined) const {
        if (refined.isAtEnd()) throwOtherPolygons();
        return refined.take<Corners>();
    }

    /// Throws Error because the source returned different polygons in two passes, so it has changed.
    [[noreturn]] void throwOtherPolygons() const {
        source_.requireUnchanged();
        throw Error(source_.summary().path, "the input changed while it was read");
    }

    bool isInOneChunk(std::span<const Corners> fan) const {
        return chunk::isInOneChunk(fan, [&](std::uint64_t vertex) { return chunkOf(vertex); });
    }

    void addFan(std::span<const Corners> fan) {
        writer_.putFan(fan, chunkOf(fan.front()[0]));
        for (const Corners& t : fan)
            markNeeded(t);
    }

    /// Counts a polygon in each chunk that contains one of its corners, before its final triangulation is known. The
    /// size is an upper bound, because a chunk receives at most all triangles of the polygon.
    void countInAllItsChunks(std::span<const read::TriangleCorners> fan) {
        std::vector<std::uint32_t> chunks;
        for (const read::TriangleCorners& t : fan) {
            markNeeded(t);
            for (const std::uint64_t corner : t)
                chunks.push_back(chunkOf(corner));
        }
        std::sort(chunks.begin(), chunks.end());
        chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
        for (const std::uint32_t chunk : chunks)
            if (chunk != kOutsideGrid) writer_.count(chunk, {fan.size(), 2 * fan.size()});
    }

    void add(const Corners& corners) {
        if (isDropped(corners)) return;
        markNeeded(corners);
        writer_.putTriangle(corners, {chunkOf(corners[0]), chunkOf(corners[1]), chunkOf(corners[2])});
    }

    read::MeshSource& source_;
    scratch::StreamStore* bins_; // the output; null if the object only counts
    ChunkWriter writer_;
    std::size_t polygonCorners_;
    Progress& progress_;
    const ChunkTree& tree_;
    HeavyPoints heavy_;
    std::vector<std::uint32_t> heavyChunks_; // chunk of each heavy point; the last entry is kOutsideGrid
    std::vector<bool> isHeavy_;              // per chunk: whether it contains a heavy point
    // The location of each vertex. Numbers below chunkCount() are chunks. The next numbers are chunkCount() plus a
    // result of HeavyPoints::find. The last number is outsideGrid().
    VertexNumbers placeOf_;
    // Per vertex: whether it lies at a heavy point and a triangle uses it. The list is empty without heavy points.
    std::vector<bool> isNeeded_;
    DroppedTriangles dropped_;
    Box strays_;
    std::uint32_t polygons_; // number of the stream SourceStream::Polygons
    std::uint32_t triangles_;
};

} // namespace

ChunkTree planChunks(
    read::MeshSource& source, const SourceSurvey& survey, std::uint32_t chunkTriangles, Progress& progress) {
    const std::uint64_t limit = std::uint64_t{3} * chunkTriangles;
    const GridSnap snap(survey.grid);
    CellCounts counts(survey.furthest, rootBitsFor(survey.vertices));
    do {
        progress.stage("octree", "vertices", survey.vertices);
        source.readVertices([&](const read::VertexBlock& block) {
            for (std::size_t i = 0; i < block.positions.size(); ++i)
                if (const std::uint8_t valence = survey.valence[block.firstVertex + i];
                    valence > 0 && snap.isInRange(block.positions[i]))
                    counts.add(snap(block.positions[i]), valence);
            progress.advance(block.positions.size());
        });
    } while (counts.refine(limit / 8));
    return treeOf(counts, limit, source.summary().path);
}

ChunkTree treeOf(const CellCounts& counts, std::uint64_t limit, const std::string& path) {
    ChunkTree tree(counts, limit);
    if (tree.chunkCount() > kMaxChunks)
        throw LimitError(
            Limit::ChunkTriangles,
            {path,
             "the chunks are too small for this model",
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
