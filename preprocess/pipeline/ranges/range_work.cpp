#include "preprocess/pipeline/ranges/range_work.h"

#include "preprocess/chunk/chunk_writer.h"
#include "preprocess/chunk/field_numbers.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/read/polygon.h"

#include <algorithm>
#include <optional>

namespace gnomon::pipeline {

namespace {

using Corners = chunk::VertexTable<std::uint8_t>;

static_assert(kPageVertices == Corners::kPageVertices);

constexpr std::uint64_t kSparseBytes = 3; // bytes per used vertex, for a page with few used vertices

/// Encodes the triangle corner counts of a page of vertices. The result has one byte per vertex, or the index and the
/// count of each used vertex if this is smaller.
std::vector<std::byte> packedPage(std::span<const std::uint8_t> corners) {
    const auto used = static_cast<std::uint64_t>(
        std::count_if(corners.begin(), corners.end(), [](std::uint8_t count) { return count > 0; }));
    const auto bytes = std::as_bytes(corners);
    if (used * kSparseBytes >= corners.size()) return {bytes.begin(), bytes.end()};
    std::vector<std::byte> packed;
    packed.reserve(used * kSparseBytes);
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] > 0)
            packed.insert(packed.end(), {std::byte(i & 0xFFU), std::byte(i >> 8U), std::byte(corners[i])});
    return packed;
}

/// Decodes triangle corner counts that `packedPage` returned and adds them to `corners`. A sum is at most 255.
void addPage(std::span<std::uint8_t> corners, std::span<const std::byte> packed) {
    const auto add = [&](std::size_t vertex, std::byte count) {
        corners[vertex] = static_cast<std::uint8_t>(std::min(255U, corners[vertex] + std::to_integer<unsigned>(count)));
    };
    if (packed.size() == corners.size()) {
        for (std::size_t i = 0; i < corners.size(); ++i)
            add(i, packed[i]);
        return;
    }
    for (std::size_t i = 0; i + kSparseBytes <= packed.size(); i += kSparseBytes)
        add(std::to_integer<std::size_t>(packed[i]) | std::to_integer<std::size_t>(packed[i + 1]) << 8U, packed[i + 2]);
}

template <class T>
std::vector<T> valuesOf(std::span<const std::byte> bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

/// Moves the list of blocks in `store`, which a task wrote, into the task's result `range`.
void collect(const scratch::StreamStore& store, const chunk::ChunkWriter& writer, BinnedRange& range) {
    for (std::uint32_t stream = 0; stream < store.streamCount(); ++stream)
        for (const scratch::Block& block : store.blocks(stream))
            range.streams.push_back({stream, block});
    for (std::uint32_t chunk = 0; chunk < writer.sizes().size(); ++chunk)
        if (const chunk::PartSize& size = writer.sizes()[chunk]; size.triangles + size.vertices > 0)
            range.sizes.emplace_back(chunk, size);
    range.strayed.triangles = writer.outsideGrid();
}

} // namespace

/// Adds the size of one task's per-vertex tables to the total of all tasks.
class RangeWork::Held {
public:
    explicit Held(const RangeWork& work) : work_(work) {}

    ~Held() { set(0); }

    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    Held(Held&&) = delete;
    Held& operator=(Held&&) = delete;

    void set(std::uint64_t bytes) {
        // If the size decreases, the unsigned difference wraps around, and the sum is still correct.
        const std::uint64_t all = work_.tableBytes_ += bytes - std::exchange(bytes_, bytes);
        std::uint64_t before = work_.maxTableBytes_;
        while (all > before && !work_.maxTableBytes_.compare_exchange_weak(before, all)) {
        }
    }

private:
    const RangeWork& work_;
    std::uint64_t bytes_ = 0;
};

Blocks RangeWork::posted(std::span<const std::byte> bytes) const {
    if (bytes.empty()) return {};
    return {scratch_.append(bytes)};
}

void RangeWork::useIndex(const Blocks& index) const {
    std::call_once(isIndexed_, [&] { source_.takeRowIndex(decodedRowIndex(scratch_.read(index))); });
}

FaceCount RangeWork::countFaces(const CountInput& input) const {
    useIndex(input.faces.index);
    FaceCount count;
    Corners corners(source_.summary().vertexCount);
    chunk::EdgeSample sample(source_.triangleCount());
    Held held(*this);
    const auto post = [&] {
        held.set(corners.held() * kPageVertices);
        for (std::size_t page = 0; page < corners.pageCount(); ++page) {
            if (corners.page(page).empty()) continue;
            const std::vector<std::byte> packed = packedPage(corners.page(page));
            if (!packed.empty()) count.pages.push_back({static_cast<std::uint32_t>(page), scratch_.append(packed)});
        }
        corners.clear();
    };
    count.isRegular = source_.readFaceRange(input.faces.begin, input.faces.end, [&](const read::TriangleBlock& block) {
        std::uint64_t index = block.firstTriangle;
        for (const read::TriangleCorners& triangle : block.triangles) {
            if (corners.held() + 3 > std::max<std::uint64_t>(input.maxPages, 3)) post();
            for (const std::uint64_t corner : triangle)
                if (std::uint8_t& valence = corners.at(corner); valence < 255) ++valence;
            sample.offer(index++, triangle);
        }
        count.triangles += block.triangles.size();
        count.notAPolygon += block.notAPolygon;
        count.hasPolygons |= !block.polygons.empty();
        progress_.advance(block.faceCount());
    });
    post();
    count.sample = posted(std::as_bytes(std::span(sample.entries())));
    return count;
}

VertexMeasure RangeWork::measureVertices(const MeasureInput& input) const {
    const RowRange& range = input.vertices;
    useIndex(range.index);
    Corners corners(source_.summary().vertexCount);
    for (const auto& [page, block] : input.pages)
        addPage(corners.pageAt(page), scratch_.read({&block, 1}));
    Held held(*this);
    held.set(range.end - range.begin);
    const auto sampled = valuesOf<std::uint64_t>(scratch_.read(input.sampled));
    std::vector<glm::dvec3> positions;
    positions.reserve(sampled.size());
    VertexMeasure measure;
    std::vector<hierarchy::Field> fields = chunk::unmeasuredFields(source_.summary());
    source_.readVertexRange(range.begin, range.end, [&](const read::VertexBlock& block) {
        chunk::addUsed(source_, block, corners, measure.box);
        chunk::addUsed(source_, block, corners, fields);
        measure.badNormals += block.badNormals;
        const std::uint64_t end = block.firstVertex + block.positions.size();
        while (positions.size() < sampled.size() && sampled[positions.size()] < end)
            positions.push_back(block.positions[sampled[positions.size()] - block.firstVertex]);
        progress_.advance(block.positions.size());
    });
    for (const hierarchy::Field& field : fields)
        measure.fields.push_back({field.min, field.max});
    std::vector<std::byte> valence(range.end - range.begin);
    for (std::uint64_t v = range.begin; v < range.end; v += kPageVertices) {
        const auto page = std::as_bytes(corners.page(v / kPageVertices));
        std::copy_n(
            page.begin(),
            std::min<std::uint64_t>(page.size(), range.end - v),
            valence.begin() + static_cast<std::ptrdiff_t>(v - range.begin));
    }
    measure.valence = posted(valence);
    measure.positions = posted(std::as_bytes(std::span(positions)));
    return measure;
}

Blocks RangeWork::countCells(const CellsInput& input) const {
    useIndex(input.vertices.index);
    const std::vector<std::byte> valence = scratch_.read(input.valence);
    chunk::CellCounts counts(
        input.facts.furthest, scratch_.read(input.shape), chunk::rootBitsFor(source_.summary().vertexCount));
    const chunk::GridSnap snap(input.facts.grid);
    source_.readVertexRange(input.vertices.begin, input.vertices.end, [&](const read::VertexBlock& block) {
        const std::byte* corners = valence.data() + (block.firstVertex - input.vertices.begin);
        for (std::size_t i = 0; i < block.positions.size(); ++i)
            if (const auto weight = std::to_integer<std::uint32_t>(corners[i]);
                weight > 0 && snap.isInRange(block.positions[i]))
                counts.add(snap(block.positions[i]), weight);
        progress_.advance(block.positions.size());
    });
    return posted(counts.openWeights());
}

namespace {

/// Stores the chunk numbers of vertices in the scratch file, one block per page of kPageVertices vertices. Returns the
/// blocks.
template <class Number>
std::vector<scratch::Block> storedPages(const std::vector<Number>& numbers, scratch::ScratchFile& scratch) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(numbers));
    const std::uint64_t pageBytes = kPageVertices * sizeof(Number);
    std::vector<scratch::Block> pages;
    for (std::uint64_t at = 0; at < bytes.size(); at += pageBytes)
        pages.push_back(scratch.append(bytes.subspan(at, std::min(pageBytes, bytes.size() - at))));
    return pages;
}

} // namespace

BinnedRange RangeWork::binVertices(const BinVerticesInput& input) const {
    const RowRange& range = input.vertices;
    useIndex(range.index);
    const chunk::ChunkTree tree(scratch_.read(input.tree));
    const std::vector<std::byte> valence = scratch_.read(input.valence);
    const bool isWide = tree.chunkCount() > chunk::kNarrowChunks;
    std::vector<std::uint16_t> narrow(isWide ? 0 : range.end - range.begin);
    std::vector<std::uint32_t> wide(isWide ? range.end - range.begin : 0);
    Held held(*this);
    held.set((range.end - range.begin) * (isWide ? 5 : 3));
    scratch::StreamStore store(scratch_, chunk::binStreams(tree.chunkCount()), input.blockBytes);
    chunk::ChunkWriter writer(chunk::formatOf(source_.summary()), input.fields, &store, tree.chunkCount());
    const chunk::GridSnap snap(input.facts.grid);
    BinnedRange binned;
    source_.readVertexRange(range.begin, range.end, [&](const read::VertexBlock& block) {
        const std::uint64_t first = block.firstVertex - range.begin;
        const auto put = [&](std::size_t i) {
            const bool isInRange = snap.isInRange(block.positions[i]);
            const std::uint32_t chunk = isInRange ? tree.chunkOf(snap(block.positions[i])) : chunk::kOutsideGrid;
            if (isInRange)
                writer.putVertex(block, i, chunk);
            else
                binned.strayed.corners.add(block.positions[i]);
            return chunk;
        };
        for (std::size_t i = 0; i < block.positions.size(); ++i) {
            if (valence[first + i] == std::byte{0}) continue;
            const std::uint32_t chunk = put(i);
            if (isWide)
                wide[first + i] = chunk;
            else
                narrow[first + i] = static_cast<std::uint16_t>(chunk);
        }
        progress_.advance(block.positions.size());
    });
    store.flush();
    collect(store, writer, binned);
    binned.chunks = isWide ? storedPages(wide, scratch_) : storedPages(narrow, scratch_);
    return binned;
}

namespace {

/// The chunk number of each vertex, in pages. A page is read from the scratch file at its first use.
template <class Number>
class ChunkNumbers {
public:
    ChunkNumbers(const BinFacesInput& input, std::uint64_t vertices, scratch::ScratchFile& scratch)
        : input_(input), vertices_(vertices), scratch_(scratch), numbers_(vertices) {}

    std::uint32_t operator()(std::uint64_t vertex) {
        const std::size_t page = vertex / kPageVertices;
        if (numbers_.page(page).empty()) load(page);
        const Number number = numbers_[vertex];
        return number == static_cast<Number>(chunk::kOutsideGrid) ? chunk::kOutsideGrid : number;
    }

    /// Returns the peak size in bytes of the pages in memory.
    std::uint64_t maxBytes() const { return maxHeld_ * kPageVertices * sizeof(Number); }

private:
    void load(std::size_t page) {
        if (numbers_.held() >= input_.maxPages) numbers_.clear();
        const std::span<Number> numbers =
            numbers_.pageAt(page).first(std::min<std::uint64_t>(kPageVertices, vertices_ - page * kPageVertices));
        maxHeld_ = std::max(maxHeld_, numbers_.held());
        scratch_.read(input_.chunks[page], std::as_writable_bytes(numbers));
    }

    const BinFacesInput& input_;
    std::uint64_t vertices_;
    scratch::ScratchFile& scratch_;
    chunk::VertexTable<Number> numbers_;
    std::size_t maxHeld_ = 0; // peak number of pages in memory
};

/// Sorts faces into chunks. One call of `bin` processes as many faces as the memory for the positions of polygon
/// corners permits.
template <class Number>
class FaceBins {
public:
    FaceBins(
        read::MeshSource& source,
        const BinFacesInput& input,
        scratch::ScratchFile& scratch,
        chunk::ChunkWriter& writer,
        Progress& progress)
        : source_(source),
          input_(input),
          chunkOf_(input, source.summary().vertexCount, scratch),
          writer_(writer),
          progress_(progress),
          refiner_(progress) {}

    /// Sorts faces into chunks, beginning with face `begin`. Returns the first face that it did not process.
    std::uint64_t bin(std::uint64_t begin) {
        std::uint64_t end = input_.faces.end;
        std::vector<std::uint64_t> corners;
        if (input_.maxCorners > 0) end = findCorners(begin, corners);
        const auto positions = chunk::VertexLookup::byRanges(source_, std::move(corners));
        readFaces(begin, end, [&](const read::TriangleBlock& block) {
            block.forEachFace([&](std::span<const read::TriangleCorners> face) {
                if (face.size() == 1)
                    put(face.front());
                else if (isInOneChunk(face))
                    writer_.putFan(face, chunkOf_(face.front()[0]));
                else
                    putRefined(face, positions);
            });
            progress_.advance(block.faceCount());
        });
        return end;
    }

    /// Returns the peak size in bytes of the tables of chunk numbers.
    std::uint64_t maxBytes() const { return chunkOf_.maxBytes(); }

private:
    void put(const read::TriangleCorners& t) {
        writer_.putTriangle(t, {chunkOf_(t[0]), chunkOf_(t[1]), chunkOf_(t[2])});
    }

    void putRefined(std::span<const read::TriangleCorners> fan, const chunk::VertexLookup& positions) {
        std::vector<read::TriangleCorners> refined(fan.begin(), fan.end());
        refiner_.refine(refined, [&](std::uint64_t vertex) { return positions[vertex]; });
        for (const read::TriangleCorners& t : refined)
            put(t);
    }

    bool isInOneChunk(std::span<const read::TriangleCorners> fan) {
        return chunk::isInOneChunk(fan, [&](std::uint64_t vertex) { return chunkOf_(vertex); });
    }

    /// Collects the corners of polygons that lie in several chunks. Returns the first face that it did not process.
    std::uint64_t findCorners(std::uint64_t begin, std::vector<std::uint64_t>& corners) {
        std::uint64_t end = begin;
        readFaces(begin, input_.faces.end, [&](const read::TriangleBlock& block) {
            if (corners.size() >= input_.maxCorners) return;
            end += block.faceCount();
            block.forEachFace([&](std::span<const read::TriangleCorners> face) {
                if (face.size() == 1 || isInOneChunk(face)) return;
                for (const read::TriangleCorners& t : face)
                    corners.insert(corners.end(), t.begin(), t.end());
            });
        });
        return end;
    }

    void readFaces(std::uint64_t begin, std::uint64_t end, const read::TriangleSink& sink) {
        if (source_.readFaceRange(begin, end, sink)) return;
        source_.requireUnchanged();
        throw Error(source_.summary().path, "the input changed while it was read");
    }

    read::MeshSource& source_;
    const BinFacesInput& input_;
    ChunkNumbers<Number> chunkOf_;
    chunk::ChunkWriter& writer_;
    Progress& progress_;
    read::PolygonRefiner refiner_;
};

} // namespace

BinnedRange RangeWork::binFaces(const BinFacesInput& input) const {
    useIndex(input.faces.index);
    scratch::StreamStore store(scratch_, chunk::binStreams(input.chunkCount), input.blockBytes);
    chunk::ChunkWriter writer(chunk::formatOf(source_.summary()), {}, &store, input.chunkCount);
    Held held(*this);
    const auto bin = [&](auto faces) {
        for (std::uint64_t begin = input.faces.begin; begin < input.faces.end;) {
            begin = faces.bin(begin);
            held.set(faces.maxBytes());
        }
    };
    if (input.chunkCount > chunk::kNarrowChunks)
        bin(FaceBins<std::uint32_t>(source_, input, scratch_, writer, progress_));
    else
        bin(FaceBins<std::uint16_t>(source_, input, scratch_, writer, progress_));
    store.flush();
    BinnedRange binned;
    collect(store, writer, binned);
    return binned;
}

} // namespace gnomon::pipeline
