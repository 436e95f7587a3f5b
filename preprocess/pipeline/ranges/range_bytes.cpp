#include "preprocess/pipeline/ranges/range_bytes.h"

namespace gnomon::pipeline {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

void putRange(ByteWriter& out, const RowRange& range) {
    out.putVarint(range.begin);
    out.putVarint(range.end);
    putBlocks(out, range.index);
}

RowRange takeRange(ByteReader& in) {
    RowRange range;
    range.begin = in.takeVarint();
    range.end = in.takeVarint();
    if (range.end < range.begin) throw hierarchy::Damage{"a range ends before it begins"};
    range.index = takeBlocks(in);
    return range;
}

void putVector(ByteWriter& out, const glm::dvec3& v) {
    for (int axis = 0; axis < 3; ++axis)
        out.put(v[axis]);
}

glm::dvec3 takeVector(ByteReader& in) {
    glm::dvec3 v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = in.take<double>();
    return v;
}

void putBox(ByteWriter& out, const Box& box) {
    putVector(out, box.min);
    putVector(out, box.max);
}

Box takeBox(ByteReader& in) {
    Box box;
    box.min = takeVector(in);
    box.max = takeVector(in);
    return box;
}

void putFacts(ByteWriter& out, const SortFacts& facts) {
    putVector(out, facts.grid.origin);
    out.put(facts.grid.stepExponent);
    for (const std::uint32_t coordinate : {facts.furthest.x, facts.furthest.y, facts.furthest.z})
        out.putVarint(coordinate);
}

SortFacts takeFacts(ByteReader& in) {
    SortFacts facts;
    facts.grid.origin = takeVector(in);
    facts.grid.stepExponent = in.take<decltype(facts.grid.stepExponent)>();
    for (std::uint32_t* coordinate : {&facts.furthest.x, &facts.furthest.y, &facts.furthest.z})
        *coordinate = static_cast<std::uint32_t>(in.takeVarint());
    return facts;
}

void putPlaces(ByteWriter& out, const std::vector<read::RowIndex::Place>& places) {
    out.putVarint(places.size());
    for (const read::RowIndex::Place& place : places)
        for (const std::uint64_t value : {place.offset, place.line, place.triangle})
            out.putVarint(value);
}

std::vector<read::RowIndex::Place> takePlaces(ByteReader& in) {
    std::vector<read::RowIndex::Place> places(takeCount(in));
    for (read::RowIndex::Place& place : places)
        for (std::uint64_t* value : {&place.offset, &place.line, &place.triangle})
            *value = in.takeVarint();
    return places;
}

} // namespace

std::vector<std::byte> encoded(const read::RowIndex& index) {
    ByteWriter out;
    out.putVarint(index.parts.size());
    for (const read::RowIndex::Part& part : index.parts) {
        putPlaces(out, part.vertices);
        putPlaces(out, part.faces);
        out.putVarint(part.triangles);
    }
    return out.take();
}

read::RowIndex decodedRowIndex(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    read::RowIndex index;
    index.parts.resize(takeCount(in));
    for (read::RowIndex::Part& part : index.parts) {
        part.vertices = takePlaces(in);
        part.faces = takePlaces(in);
        part.triangles = in.takeVarint();
    }
    in.expectEnd();
    return index;
}

std::vector<std::byte> encoded(const CountInput& input) {
    ByteWriter out;
    putRange(out, input.faces);
    out.putVarint(input.maxPages);
    return out.take();
}

CountInput takeCountInput(ByteReader& in) {
    CountInput input;
    input.faces = takeRange(in);
    input.maxPages = in.takeVarint();
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const FaceCount& count) {
    ByteWriter out;
    out.put(static_cast<std::uint8_t>(count.isRegular ? 1 : 0));
    out.putVarint(count.triangles);
    out.putVarint(count.notAPolygon);
    out.put(static_cast<std::uint8_t>(count.hasPolygons ? 1 : 0));
    putMail(out, count.pages);
    putBlocks(out, count.sample);
    return out.take();
}

FaceCount decodedFaceCount(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    FaceCount count;
    count.isRegular = in.take<std::uint8_t>() != 0;
    count.triangles = in.takeVarint();
    count.notAPolygon = in.takeVarint();
    count.hasPolygons = in.take<std::uint8_t>() != 0;
    count.pages = takeMail(in);
    count.sample = takeBlocks(in);
    in.expectEnd();
    return count;
}

std::vector<std::byte> encoded(const MeasureInput& input) {
    ByteWriter out;
    putRange(out, input.vertices);
    putMail(out, input.pages);
    putBlocks(out, input.sampled);
    return out.take();
}

MeasureInput takeMeasureInput(ByteReader& in) {
    MeasureInput input;
    input.vertices = takeRange(in);
    input.pages = takeMail(in);
    input.sampled = takeBlocks(in);
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const VertexMeasure& measure) {
    ByteWriter out;
    putBox(out, measure.box);
    out.putVarint(measure.fields.size());
    for (const auto& [min, max] : measure.fields) {
        out.put(min);
        out.put(max);
    }
    out.putVarint(measure.badNormals);
    putBlocks(out, measure.valence);
    putBlocks(out, measure.positions);
    return out.take();
}

VertexMeasure decodedMeasure(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    VertexMeasure measure;
    measure.box = takeBox(in);
    measure.fields.resize(takeCount(in));
    for (auto& [min, max] : measure.fields) {
        min = in.take<double>();
        max = in.take<double>();
    }
    measure.badNormals = in.takeVarint();
    measure.valence = takeBlocks(in);
    measure.positions = takeBlocks(in);
    in.expectEnd();
    return measure;
}

std::vector<std::byte> encoded(const CellsInput& input) {
    ByteWriter out;
    putRange(out, input.vertices);
    putFacts(out, input.facts);
    putBlocks(out, input.valence);
    putBlocks(out, input.shape);
    return out.take();
}

CellsInput takeCellsInput(ByteReader& in) {
    CellsInput input;
    input.vertices = takeRange(in);
    input.facts = takeFacts(in);
    input.valence = takeBlocks(in);
    input.shape = takeBlocks(in);
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const BinVerticesInput& input) {
    ByteWriter out;
    putRange(out, input.vertices);
    putFacts(out, input.facts);
    out.putVarint(input.fields.size());
    for (const hierarchy::Field& field : input.fields) {
        out.putText(field.name);
        out.put(field.min);
        out.put(field.max);
        out.putVarint(field.bits);
    }
    putBlocks(out, input.valence);
    putBlocks(out, input.tree);
    out.putVarint(input.blockBytes);
    return out.take();
}

BinVerticesInput takeBinVerticesInput(ByteReader& in) {
    BinVerticesInput input;
    input.vertices = takeRange(in);
    input.facts = takeFacts(in);
    input.fields.resize(takeCount(in));
    for (hierarchy::Field& field : input.fields) {
        field.name = in.takeText();
        field.min = in.take<double>();
        field.max = in.take<double>();
        field.bits = static_cast<decltype(field.bits)>(in.takeVarint());
    }
    input.valence = takeBlocks(in);
    input.tree = takeBlocks(in);
    input.blockBytes = in.takeVarint();
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const BinFacesInput& input) {
    ByteWriter out;
    putRange(out, input.faces);
    out.putVarint(input.chunkCount);
    putBlocks(out, input.chunks);
    out.putVarint(input.maxPages);
    out.putVarint(input.maxCorners);
    out.putVarint(input.blockBytes);
    return out.take();
}

BinFacesInput takeBinFacesInput(ByteReader& in) {
    BinFacesInput input;
    input.faces = takeRange(in);
    input.chunkCount = static_cast<std::uint32_t>(in.takeVarint());
    input.chunks = takeBlocks(in);
    input.maxPages = in.takeVarint();
    input.maxCorners = in.takeVarint();
    input.blockBytes = in.takeVarint();
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const BinnedRange& range) {
    ByteWriter out;
    putMail(out, range.streams);
    out.putVarint(range.sizes.size());
    for (const auto& [chunk, size] : range.sizes) {
        out.putVarint(chunk);
        out.putVarint(size.triangles);
        out.putVarint(size.vertices);
    }
    out.putVarint(range.strayed.triangles);
    putBox(out, range.strayed.corners);
    putBlocks(out, range.chunks);
    return out.take();
}

BinnedRange decodedBinnedRange(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    BinnedRange range;
    range.streams = takeMail(in);
    range.sizes.resize(takeCount(in));
    for (auto& [chunk, size] : range.sizes) {
        chunk = static_cast<std::uint32_t>(in.takeVarint());
        size.triangles = in.takeVarint();
        size.vertices = in.takeVarint();
    }
    range.strayed.triangles = in.takeVarint();
    range.strayed.corners = takeBox(in);
    range.chunks = takeBlocks(in);
    in.expectEnd();
    return range;
}

} // namespace gnomon::pipeline
