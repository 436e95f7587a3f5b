#include "preprocess/chunk/chunk_tree.h"

#include "hierarchy/bytes.h"

#include <algorithm>
#include <bit>

namespace gnomon::chunk {

namespace {

constexpr int kRootBits = CellCounts::kMaxRootBits;
constexpr int kFinerBits = 3;

/// Returns the low bits of `value` with two zero bits between neighbouring bits. The result is one coordinate of a
/// Morton code.
constexpr std::uint32_t spread(std::uint32_t value) {
    std::uint32_t result = 0;
    for (std::uint32_t bit = 0; bit < kRootBits; ++bit)
        result |= (value >> bit & 1U) << (3 * bit);
    return result;
}

constexpr auto kSpread = [] {
    std::array<std::uint32_t, 1U << kRootBits> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i)
        table[i] = spread(i);
    return table;
}();

std::uint32_t mortonCell(const hierarchy::GridPoint& point, int bits, int shift) {
    const std::uint32_t mask = (1U << bits) - 1;
    return kSpread[point.x >> shift & mask] | kSpread[point.y >> shift & mask] << 1U |
           kSpread[point.z >> shift & mask] << 2U;
}

/// Returns the coordinate of an octree cell on one axis. `cell` is the Morton code of the cell.
std::uint32_t gathered(std::uint32_t cell, std::uint32_t axis) {
    std::uint32_t result = 0;
    for (std::uint32_t bit = 0; bit < kRootBits; ++bit)
        result |= (cell >> (3 * bit + axis) & 1U) << bit;
    return result;
}

} // namespace

int rootBitsFor(std::uint64_t vertices) {
    constexpr std::uint64_t kFew = std::uint64_t{1} << 22U;
    return vertices < kFew ? 5 : kRootBits;
}

CellCounts::CellCounts(const hierarchy::GridPoint& furthest, int rootBits) {
    const int width = static_cast<int>(std::bit_width(std::max({furthest.x, furthest.y, furthest.z, 1U})));
    const int bits = std::min({rootBits, kRootBits, width});
    tables_.push_back(makeTable(bits, width - bits));
}

CellCounts::Table CellCounts::makeTable(int bits, int shift) {
    const std::size_t cells = std::size_t{1} << static_cast<unsigned>(3 * bits);
    return {bits, shift, std::vector<std::uint64_t>(cells), {}};
}

std::uint32_t CellCounts::cellOf(const Table& table, const hierarchy::GridPoint& point) {
    return mortonCell(point, table.bits, table.shift);
}

void CellCounts::add(const hierarchy::GridPoint& point, std::uint32_t weight) {
    std::size_t table = 0;
    for (;;) {
        const std::uint32_t cell = cellOf(tables_[table], point);
        const std::int32_t finer = finerThan(tables_[table], cell);
        if (finer < 0) {
            if (table >= firstOpen_) tables_[table].weights[cell] += weight;
            return;
        }
        table = static_cast<std::size_t>(finer);
    }
}

void CellCounts::cut(const Parent& parent) {
    Table& table = tables_[parent.table];
    if (table.finer.empty()) table.finer.assign(table.weights.size(), -1);
    table.finer[parent.cell] = static_cast<std::int32_t>(tables_.size());
    const int bits = std::min(kFinerBits, table.shift);
    tables_.push_back(makeTable(bits, table.shift - bits)); // the reference `table` is invalid after this line
    parents_.push_back(parent);
}

std::vector<std::byte> CellCounts::shape() const {
    hierarchy::ByteWriter out;
    out.putVarint(firstOpen_);
    out.putVarint(parents_.size());
    for (const Parent& parent : parents_) {
        out.putVarint(parent.table);
        out.putVarint(parent.cell);
    }
    return out.take();
}

CellCounts::CellCounts(const hierarchy::GridPoint& furthest, std::span<const std::byte> shape, int rootBits)
    : CellCounts(furthest, rootBits) {
    hierarchy::ByteReader in(shape);
    firstOpen_ = in.takeVarint();
    for (std::uint64_t left = in.takeVarint(); left > 0; --left) {
        Parent parent;
        parent.table = static_cast<std::uint32_t>(in.takeVarint());
        parent.cell = static_cast<std::uint32_t>(in.takeVarint());
        if (parent.table >= tables_.size() || parent.cell >= tables_[parent.table].weights.size())
            throw hierarchy::Damage{"it refers to a missing cell"};
        cut(parent);
    }
    in.expectEnd();
}

std::vector<std::byte> CellCounts::openWeights() const {
    hierarchy::ByteWriter out;
    for (std::size_t t = firstOpen_; t < tables_.size(); ++t) {
        std::size_t next = 0;
        for (std::size_t cell = 0; cell < tables_[t].weights.size(); ++cell) {
            if (tables_[t].weights[cell] == 0) continue;
            out.putVarint(1 + cell - next);
            out.putVarint(tables_[t].weights[cell]);
            next = cell + 1;
        }
        out.putVarint(0);
    }
    return out.take();
}

void CellCounts::addOpenWeights(std::span<const std::byte> weights) {
    hierarchy::ByteReader in(weights);
    for (std::size_t t = firstOpen_; t < tables_.size(); ++t) {
        std::size_t next = 0;
        while (const std::uint64_t step = in.takeVarint()) {
            if (step > tables_[t].weights.size() - next) throw hierarchy::Damage{"it refers to a missing cell"};
            next += step;
            tables_[t].weights[next - 1] += in.takeVarint();
        }
    }
    in.expectEnd();
}

bool CellCounts::refine(std::uint64_t limit) {
    const std::size_t known = tables_.size();
    for (std::size_t t = firstOpen_; t < known; ++t) {
        if (tables_[t].shift == 0) continue;
        for (std::uint32_t cell = 0; cell < tables_[t].weights.size(); ++cell)
            if (tables_[t].weights[cell] > limit) cut({static_cast<std::uint32_t>(t), cell});
    }
    firstOpen_ = known;
    return tables_.size() > known;
}

std::vector<hierarchy::GridPoint> CellCounts::pointsAbove(std::uint64_t limit) const {
    std::vector<hierarchy::GridPoint> points;
    collectAbove(limit, 0, {}, points);
    return points;
}

void CellCounts::collectAbove(
    std::uint64_t limit,
    std::size_t table,
    const hierarchy::GridPoint& corner,
    std::vector<hierarchy::GridPoint>& points) const {
    const Table& cells = tables_[table];
    for (std::uint32_t cell = 0; cell < cells.weights.size(); ++cell) {
        if (cells.weights[cell] <= limit) continue;
        const hierarchy::GridPoint at{
            corner.x | gathered(cell, 0) << cells.shift,
            corner.y | gathered(cell, 1) << cells.shift,
            corner.z | gathered(cell, 2) << cells.shift};
        if (cells.shift == 0)
            points.push_back(at);
        else if (const std::int32_t finer = finerThan(cells, cell); finer >= 0)
            collectAbove(limit, static_cast<std::size_t>(finer), at, points);
    }
}

ChunkTree::ChunkTree(const CellCounts& counts, std::uint64_t limit) : heavyPoints_(counts.pointsAbove(limit / 8)) {
    tables_.reserve(counts.tables_.size());
    for (const CellCounts::Table& table : counts.tables_)
        tables_.push_back({table.bits, table.shift, std::vector<std::uint32_t>(table.weights.size())});
    cut(counts, 0, 0, counts.tables_.front().weights.size(), limit);
}

void ChunkTree::cut(
    const CellCounts& counts, std::size_t table, std::size_t begin, std::size_t end, std::uint64_t limit) {
    const CellCounts::Table& cells = counts.tables_[table];
    std::uint64_t weight = 0;
    for (std::size_t cell = begin; cell < end; ++cell)
        weight += cells.weights[cell];
    if (weight == 0) return;
    if (!weights_.empty() && weights_.back() + weight <= limit) {
        weights_.back() += weight;
        return assign(table, begin, end);
    }
    if (weight > limit / 8 && end - begin > 1) {
        const std::size_t eighth = (end - begin) / 8;
        for (std::size_t i = 0; i < 8; ++i)
            cut(counts, table, begin + i * eighth, begin + (i + 1) * eighth, limit);
        return;
    }
    if (weight > limit / 8 && CellCounts::finerThan(cells, begin) >= 0) {
        const auto finer = static_cast<std::size_t>(cells.finer[begin]);
        tables_[table].chunks[begin] = kFiner + static_cast<std::uint32_t>(finer);
        return cut(counts, finer, 0, counts.tables_[finer].weights.size(), limit);
    }
    weights_.push_back(weight);
    assign(table, begin, end);
}

void ChunkTree::assign(std::size_t table, std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell)
        tables_[table].chunks[cell] = chunkCount() - 1;
}

std::vector<std::byte> ChunkTree::encoded() const {
    hierarchy::ByteWriter out;
    out.putVarint(weights_.size());
    out.putVarint(tables_.size());
    for (const Table& table : tables_) {
        out.putVarint(static_cast<std::uint64_t>(table.bits));
        out.putVarint(static_cast<std::uint64_t>(table.shift));
        for (std::size_t begin = 0, end = 0; begin < table.chunks.size(); begin = end) {
            while (end < table.chunks.size() && table.chunks[end] == table.chunks[begin])
                ++end;
            out.putVarint(table.chunks[begin]);
            out.putVarint(end - begin);
        }
    }
    return out.take();
}

ChunkTree::ChunkTree(std::span<const std::byte> bytes) {
    hierarchy::ByteReader in(bytes);
    weights_.resize(in.takeVarint());
    for (std::uint64_t left = in.takeVarint(); left > 0; --left) {
        Table& table = tables_.emplace_back();
        table.bits = static_cast<int>(in.takeVarint());
        table.shift = static_cast<int>(in.takeVarint());
        if (table.bits > kRootBits) throw hierarchy::Damage{"a table has too many cells"};
        const std::size_t cells = std::size_t{1} << static_cast<unsigned>(3 * table.bits);
        table.chunks.reserve(cells);
        while (table.chunks.size() < cells) {
            const auto chunk = static_cast<std::uint32_t>(in.takeVarint());
            const std::uint64_t count = in.takeVarint();
            if (count > cells - table.chunks.size()) throw hierarchy::Damage{"a table has too many cells"};
            table.chunks.insert(table.chunks.end(), count, chunk);
        }
    }
    in.expectEnd();
}

std::uint32_t ChunkTree::chunkOf(const hierarchy::GridPoint& point) const {
    std::uint32_t found = kFiner;
    while (found >= kFiner) {
        const Table& table = tables_[found - kFiner];
        found = table.chunks[mortonCell(point, table.bits, table.shift)];
    }
    return found;
}

} // namespace gnomon::chunk
