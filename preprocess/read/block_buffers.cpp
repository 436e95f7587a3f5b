#include "preprocess/read/block_buffers.h"

#include "core/check.h"

#include <utility>

namespace gnomon::read {

VertexBuffer::VertexBuffer(const VertexSink& sink, const Attributes& attributes, std::uint64_t first)
    : sink_(sink),
      positions_(kBlockRows),
      normals_(attributes.hasNormals ? kBlockRows : 0),
      colors_(attributes.hasColors ? kBlockRows : 0),
      fields_(attributes.fieldCount * kBlockRows),
      fieldCount_(attributes.fieldCount),
      first_(first) {}

VertexBuffer::Rows VertexBuffer::append(std::size_t count) {
    GNOMON_CHECK_OP(count, <=, room());
    Rows rows;
    rows.positions = std::span(positions_).subspan(size_, count);
    if (!normals_.empty()) rows.normals = std::span(normals_).subspan(size_, count);
    if (!colors_.empty()) rows.colors = std::span(colors_).subspan(size_, count);
    rows.fields = std::span(fields_).subspan(fieldCount_ * size_, fieldCount_ * count);
    size_ += count;
    return rows;
}

void VertexBuffer::flush() {
    if (size_ == 0) return;
    VertexBlock block;
    block.firstVertex = first_;
    block.positions = std::span(positions_).first(size_);
    if (!normals_.empty()) block.normals = std::span(normals_).first(size_);
    if (!colors_.empty()) block.colors = std::span(colors_).first(size_);
    block.fields = std::span(fields_).first(fieldCount_ * size_);
    block.badNormals = std::exchange(badNormals_, 0);
    first_ += size_;
    size_ = 0;
    sink_(block);
}

TriangleBuffer::TriangleBuffer(const TriangleSink& sink, std::uint64_t first)
    : sink_(sink), triangles_(kBlockRows), first_(first) {}

void TriangleBuffer::addPolygon(std::span<const std::uint64_t> corners) {
    if (corners.size() < 3) {
        ++notAPolygon_;
        return;
    }
    if (corners.size() == 3) return add({corners[0], corners[1], corners[2]});
    const std::size_t count = corners.size() - 2;
    if (count > room().size()) flush();
    if (count > room().size()) triangles_.resize(count);
    polygons_.push_back({static_cast<std::uint32_t>(size_), static_cast<std::uint32_t>(count)});
    for (std::size_t i = 0; i < count; ++i)
        triangles_[size_ + i] = {corners[0], corners[i + 1], corners[i + 2]};
    commit(count);
}

void TriangleBuffer::flush() {
    if (size_ == 0 && notAPolygon_ == 0) return;
    TriangleBlock block;
    block.firstTriangle = first_;
    block.triangles = std::span(triangles_).first(size_);
    block.polygons = polygons_;
    block.notAPolygon = notAPolygon_;
    first_ += size_;
    size_ = 0;
    notAPolygon_ = 0;
    sink_(block);
    polygons_.clear();
    triangles_.resize(kBlockRows);
}

} // namespace gnomon::read
