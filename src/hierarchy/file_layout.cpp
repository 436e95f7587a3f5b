#include "hierarchy/file_layout.h"

#include "hierarchy/validation.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <xxhash.h>

namespace gnomon::hierarchy {

namespace {

constexpr std::uint32_t kNormalsFlag = 1;
constexpr std::uint32_t kColorsFlag = 2;

void putPoint(ByteWriter& out, const GridPoint& p) {
    out.put(p.x);
    out.put(p.y);
    out.put(p.z);
}

GridPoint takePoint(ByteReader& in) {
    GridPoint p;
    p.x = in.take<std::uint32_t>();
    p.y = in.take<std::uint32_t>();
    p.z = in.take<std::uint32_t>();
    return p;
}

void putVector(ByteWriter& out, const glm::dvec3& v) {
    out.put(v.x);
    out.put(v.y);
    out.put(v.z);
}

glm::dvec3 takeVector(ByteReader& in) {
    glm::dvec3 v;
    v.x = in.take<double>();
    v.y = in.take<double>();
    v.z = in.take<double>();
    return v;
}

/// The size in bytes of a page table row without children.
constexpr std::uint64_t kRowBytes = 112;

} // namespace

void putPageRow(ByteWriter& out, const PageInfo& page) {
    out.put(page.storedBytes);
    out.put(page.level);
    out.put(page.checksum);
    out.put(page.groupCount);
    out.put(page.clusterCount);
    out.put(page.refinementCount);
    out.put(page.vertexCount);
    out.put(page.triangleCount);
    putPoint(out, page.box.min);
    putPoint(out, page.box.max);
    out.put(static_cast<std::uint32_t>(page.children.size()));
    putVector(out, page.bounds.center);
    out.put(page.bounds.radius);
    out.put(page.minError);
    out.put(page.maxError);
    for (const std::uint32_t child : page.children)
        out.put(child);
}

PageInfo takePageRow(ByteReader& in) {
    PageInfo page;
    page.storedBytes = in.take<std::uint32_t>();
    page.level = in.take<std::uint32_t>();
    page.checksum = in.take<std::uint64_t>();
    page.groupCount = in.take<std::uint32_t>();
    page.clusterCount = in.take<std::uint32_t>();
    page.refinementCount = in.take<std::uint32_t>();
    page.vertexCount = in.take<std::uint32_t>();
    page.triangleCount = in.take<std::uint32_t>();
    page.box.min = takePoint(in);
    page.box.max = takePoint(in);
    const auto childCount = in.take<std::uint32_t>();
    page.bounds.center = takeVector(in);
    page.bounds.radius = in.take<double>();
    page.minError = in.take<double>();
    page.maxError = in.take<double>();
    for (std::uint32_t i = 0; i < childCount; ++i)
        page.children.push_back(in.take<std::uint32_t>());
    return page;
}

namespace {

template <class Value, class Put>
void putMap(ByteWriter& out, const std::map<std::string, Value>& map, Put put) {
    out.putVarint(map.size());
    for (const auto& [key, value] : map) {
        out.putText(key);
        put(value);
    }
}

/// Decodes a map from bytes. Throws Damage if the keys are not in ascending order, so that each map has exactly one
/// encoding.
template <class Value, class Take>
std::map<std::string, Value> takeMap(ByteReader& in, Take take) {
    std::map<std::string, Value> map;
    const std::uint64_t count = in.takeVarint();
    for (std::uint64_t i = 0; i < count; ++i) {
        std::string key = in.takeText();
        if (!map.empty() && key <= map.rbegin()->first) throw Damage{"the names are not sorted"};
        map.emplace_hint(map.end(), std::move(key), take());
    }
    return map;
}

TablePlace takePlace(ByteReader& in) {
    TablePlace place;
    place.offset = in.take<std::uint64_t>();
    place.bytes = in.take<std::uint64_t>();
    place.checksum = in.take<std::uint64_t>();
    return place;
}

} // namespace

std::uint64_t checksum64(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::string hexText(const ContentHash& hash) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : hash) {
        text += kDigits[static_cast<unsigned>(byte) >> 4U];
        text += kDigits[static_cast<unsigned>(byte) & 15U];
    }
    return text;
}

std::uint32_t flagsOf(const ModelSummary& summary) {
    return (summary.hasNormals ? kNormalsFlag : 0U) | (summary.hasColors ? kColorsFlag : 0U);
}

std::vector<std::byte> encodeHeader(std::uint32_t flags, const ContentHash& hash, std::uint32_t version) {
    ByteWriter start;
    start.put(std::as_bytes(std::span(kMagic)));
    start.put(version);
    start.put(flags);
    ByteWriter covered = start;
    covered.put(hash);
    start.put(checksum64(covered.bytes()));
    start.put(hash);
    return start.take();
}

std::vector<std::byte> encodeFooter(const Footer& footer) {
    ByteWriter out;
    for (const TablePlace& place : {footer.pageTable, footer.summary}) {
        out.put(place.offset);
        out.put(place.bytes);
        out.put(place.checksum);
    }
    out.put(footer.fileBytes);
    out.put(footer.pageCount);
    out.put(checksum64(out.bytes()));
    return out.take();
}

Footer decodeFooter(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Footer footer;
    footer.pageTable = takePlace(in);
    footer.summary = takePlace(in);
    footer.fileBytes = in.take<std::uint64_t>();
    footer.pageCount = in.take<std::uint64_t>();
    if (in.take<std::uint64_t>() != checksum64(bytes.first(kFooterBytes - sizeof(std::uint64_t))))
        throw Damage{"the footer's checksum is wrong"};
    return footer;
}

std::vector<std::byte> encodePageTable(std::span<const PageInfo> pages) {
    ByteWriter out;
    for (const PageInfo& page : pages)
        putPageRow(out, page);
    return out.take();
}

std::uint64_t tableMemory(const Footer& footer) {
    const std::uint64_t pageBytes = footer.pageTable.offset - kHeaderBytes;
    const std::uint64_t maxPages = std::min(footer.pageTable.bytes / kRowBytes, pageBytes);
    if (footer.pageCount > maxPages)
        throw Damage{
            "pages: expected at most " + std::to_string(maxPages) + ", as many as the file has bytes for, found " +
            std::to_string(footer.pageCount)};
    const std::uint64_t childBytes = footer.pageTable.bytes - footer.pageCount * kRowBytes;
    return footer.pageTable.bytes + footer.pageCount * sizeof(PageInfo) + childBytes;
}

std::vector<PageInfo> decodePageTable(std::span<const std::byte> bytes, const Footer& footer, const Grid& grid) {
    ByteReader in(bytes);
    std::vector<PageInfo> pages;
    pages.reserve(std::min(footer.pageCount, bytes.size() / kRowBytes));
    std::uint64_t offset = kHeaderBytes;
    for (std::uint64_t i = 0; i < footer.pageCount; ++i) {
        PageInfo page = takePageRow(in);
        if (std::ranges::adjacent_find(page.children, std::greater_equal()) != page.children.end())
            throw Damage{"the children of a page are not sorted"};
        if (const auto fault = rowFault(page, grid)) throw Damage{"page " + std::to_string(i) + ": " + *fault};
        page.offset = offset;
        offset += page.storedBytes;
        if (!pages.empty() && page.level > pages.back().level)
            throw Damage{"the pages are not sorted from coarse to fine"};
        pages.push_back(std::move(page));
    }
    in.expectEnd();
    if (offset != footer.pageTable.offset) throw Damage{"the page table does not follow the last page"};
    for (const PageInfo& page : pages)
        for (const std::uint32_t child : page.children)
            if (child >= pages.size() || pages[child].level >= page.level)
                throw Damage{"the child of a page is not finer than the page"};
    return pages;
}

std::vector<std::byte> encodeSummary(const ModelSummary& summary) {
    ByteWriter out;
    putVector(out, summary.grid.origin);
    out.put(static_cast<std::int32_t>(summary.grid.stepExponent));
    putVector(out, summary.bounds.min);
    putVector(out, summary.bounds.max);
    out.putVarint(summary.sourceTriangles);
    out.putVarint(summary.sourceVertices);
    out.putVarint(summary.coarsestTriangles);
    out.put(flagsOf(summary));
    putMap(out, summary.dropped, [&out](std::uint64_t count) { out.putVarint(count); });
    putMap(out, summary.options, [&out](const std::string& value) { out.putText(value); });
    out.putVarint(summary.levels.size());
    for (const LevelInfo& level : summary.levels) {
        out.putVarint(level.triangles);
        out.putVarint(level.clusters);
        out.putVarint(level.groups);
        out.put(level.maxError);
    }
    putVector(out, summary.up.direction);
    out.put(static_cast<std::uint8_t>(summary.unit));
    out.putVarint(summary.fields.size());
    for (const Field& field : summary.fields) {
        out.putText(field.name);
        out.put(field.min);
        out.put(field.max);
        out.putVarint(field.bits);
    }
    for (const LevelInfo& level : summary.levels)
        out.put(level.maxAttributeError);
    return out.take();
}

namespace {

Field takeField(ByteReader& in) {
    Field field;
    field.name = in.takeText();
    field.min = in.take<double>();
    field.max = in.take<double>();
    const std::uint64_t bits = in.takeVarint();
    const bool isRange = std::isfinite(field.min) && std::isfinite(field.max) && field.min <= field.max;
    if (field.name.empty() || !isRange) throw Damage{"a field has no name or no range"};
    if (bits < 1 || bits > kMaxFieldBits) throw Damage{"a field has " + std::to_string(bits) + " bits"};
    field.bits = static_cast<std::uint32_t>(bits);
    return field;
}

/// Decodes the members of the summary that format 4 appends to those of format 3.
void takeWorldFrame(ByteReader& in, ModelSummary& summary) {
    summary.up.direction = takeVector(in);
    constexpr double kRounding = 1e-6;
    if (!(std::abs(glm::length(summary.up.direction) - 1) <= kRounding))
        throw Damage{"the up direction is not a unit vector"};
    const auto unit = in.take<std::uint8_t>();
    if (unit >= kUnits.size()) throw Damage{"unit " + std::to_string(unit) + " is unknown"};
    summary.unit = static_cast<Unit>(unit);
    const std::uint64_t fieldCount = in.takeVarint();
    for (std::uint64_t i = 0; i < fieldCount; ++i)
        // A field needs at least one byte of input, so a damaged number of fields cannot allocate unlimited memory.
        summary.fields.push_back(takeField(in));
    for (LevelInfo& level : summary.levels) {
        level.maxAttributeError = in.take<double>();
        if (!std::isfinite(level.maxAttributeError) || level.maxAttributeError < 0)
            throw Damage{"an error is negative or not finite"};
    }
}

} // namespace

ModelSummary decodeSummary(std::span<const std::byte> bytes, std::uint32_t version) {
    ByteReader in(bytes);
    ModelSummary summary;
    summary.grid.origin = takeVector(in);
    summary.grid.stepExponent = in.take<std::int32_t>();
    summary.bounds.min = takeVector(in);
    summary.bounds.max = takeVector(in);
    summary.sourceTriangles = in.takeVarint();
    summary.sourceVertices = in.takeVarint();
    summary.coarsestTriangles = in.takeVarint();
    const auto flags = in.take<std::uint32_t>();
    summary.hasNormals = (flags & kNormalsFlag) != 0;
    summary.hasColors = (flags & kColorsFlag) != 0;
    summary.dropped = takeMap<std::uint64_t>(in, [&in] { return in.takeVarint(); });
    summary.options = takeMap<std::string>(in, [&in] { return in.takeText(); });
    const std::uint64_t levelCount = in.takeVarint();
    for (std::uint64_t i = 0; i < levelCount; ++i) {
        LevelInfo level;
        level.triangles = in.takeVarint();
        level.clusters = in.takeVarint();
        level.groups = in.takeVarint();
        level.maxError = in.take<double>();
        if (!std::isfinite(level.maxError) || level.maxError < 0) throw Damage{"an error is negative or not finite"};
        summary.levels.push_back(level);
    }
    if (version > kOldestFormatVersion) takeWorldFrame(in, summary);
    in.expectEnd();
    if (const auto fault = summaryFault(summary)) throw Damage{*fault};
    return summary;
}

} // namespace gnomon::hierarchy
