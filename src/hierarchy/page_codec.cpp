#include "hierarchy/page_codec.h"

#include "core/check.h"
#include "hierarchy/bytes.h"
#include "hierarchy/codec/cluster_codec.h"
#include "hierarchy/validation.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <zstd.h>
#include <zstd_errors.h>

namespace gnomon::hierarchy {

namespace {

enum class Packing : std::uint8_t { Plain = 0, Zstd = 1 };

/// A bit of the byte that describes how a page is packed. It means that the groups and refinements of the page store
/// attribute errors. Without this bit, all attribute errors are 0. A page without attribute errors has the same bytes
/// in all formats.
constexpr std::uint8_t kAttributeErrorsBit = 2;

/// A bit of the byte that describes how a page is packed. It means that the vertices of the page have fields.
constexpr std::uint8_t kFieldsBit = 4;

/// The max ratio of decompressed to stored size of a page. It prevents a small file from requesting a large buffer.
constexpr std::uint64_t kMaxExpansion = 256;

/// The min size of a separate zstd block in bytes. In a smaller block, the entropy table costs more bytes and time than
/// it saves.
constexpr std::size_t kMinBlockBytes = 5000;

/// A page that compresses to less than this share of its size is repetitive, for example the page of a plant. It is
/// then stored in one zstd block. One block decompresses a seventh faster, and its size is almost the same.
constexpr double kRepetitiveShare = 0.4;

void putSphere(ByteWriter& out, const Sphere& sphere) {
    out.put(sphere.center.x);
    out.put(sphere.center.y);
    out.put(sphere.center.z);
    out.put(sphere.radius);
}

Sphere takeSphere(ByteReader& in) {
    Sphere sphere;
    sphere.center.x = in.take<double>();
    sphere.center.y = in.take<double>();
    sphere.center.z = in.take<double>();
    sphere.radius = in.take<double>();
    const bool finite = std::isfinite(sphere.center.x) && std::isfinite(sphere.center.y) &&
                        std::isfinite(sphere.center.z) && std::isfinite(sphere.radius);
    if (!finite || sphere.radius < 0) throw Damage{"a bounding sphere is invalid"};
    return sphere;
}

std::uint32_t takeIndex(ByteReader& in) {
    const std::uint64_t value = in.takeVarint();
    if (value >= kNone) throw Damage{"an index has more than 32 bits"};
    return static_cast<std::uint32_t>(value);
}

bool hasAttributeErrors(const Page& page) {
    const auto has = [](const auto& each) { return each.attributeError > 0; };
    return std::ranges::any_of(page.groups, has) || std::ranges::any_of(page.refinements, has);
}

double takeAttributeError(ByteReader& in) {
    const auto error = in.take<double>();
    if (!std::isfinite(error) || error < 0) throw Damage{"an error of attributes is negative or not finite"};
    return error;
}

void putTables(const Page& page, bool withAttributeErrors, ByteWriter& out) {
    const std::vector<std::uint32_t> children = childPages(page);
    for (const Group& group : page.groups) {
        out.putVarint(group.clusterCount);
        putSphere(out, group.bounds);
        out.put(group.error);
        if (withAttributeErrors) out.put(group.attributeError);
    }
    for (const Refinement& refinement : page.refinements) {
        const auto child = std::lower_bound(children.begin(), children.end(), refinement.group.page);
        out.putVarint(static_cast<std::uint64_t>(child - children.begin()));
        out.putVarint(refinement.group.group);
        putSphere(out, refinement.bounds);
        out.put(refinement.error);
        if (withAttributeErrors) out.put(refinement.attributeError);
    }
    for (const Cluster& cluster : page.clusters) {
        out.put(static_cast<std::uint8_t>(cluster.vertexCount - 1));
        out.put(static_cast<std::uint8_t>(cluster.triangleCount - 1));
        if (page.level > 0) out.putVarint(cluster.refinement);
    }
}

void takeGroups(ByteReader& in, const PageInfo& info, bool withAttributeErrors, Page& page) {
    std::uint32_t firstCluster = 0;
    for (std::uint32_t i = 0; i < info.groupCount; ++i) {
        Group group;
        group.firstCluster = firstCluster;
        group.clusterCount = takeIndex(in);
        if (group.clusterCount == 0 || group.clusterCount > info.clusterCount - firstCluster)
            throw Damage{"a group refers to missing clusters"};
        firstCluster += group.clusterCount;
        group.bounds = takeSphere(in);
        group.error = in.take<double>();
        if (std::isnan(group.error) || group.error < 0) throw Damage{"an error is negative or not finite"};
        if (withAttributeErrors) group.attributeError = takeAttributeError(in);
        page.groups.push_back(group);
    }
    if (firstCluster != info.clusterCount) throw Damage{"a cluster has no group"};
}

void takeRefinements(ByteReader& in, const PageInfo& info, bool withAttributeErrors, Page& page) {
    for (std::uint32_t i = 0; i < info.refinementCount; ++i) {
        Refinement refinement;
        const std::uint32_t child = takeIndex(in);
        if (child >= info.children.size()) throw Damage{"a refinement refers to a missing child page"};
        refinement.group.page = info.children[child];
        refinement.group.group = takeIndex(in);
        refinement.bounds = takeSphere(in);
        refinement.error = in.take<double>();
        if (!std::isfinite(refinement.error) || refinement.error < 0)
            throw Damage{"an error is negative or not finite"};
        if (withAttributeErrors) refinement.attributeError = takeAttributeError(in);
        page.refinements.push_back(refinement);
    }
}

void takeClusters(ByteReader& in, const PageInfo& info, Page& page) {
    std::uint64_t vertices = 0; // 64 bits: in a damaged page the sum over all clusters can exceed 32 bits
    std::uint64_t triangles = 0;
    for (std::uint32_t i = 0; i < info.clusterCount; ++i) {
        Cluster cluster;
        cluster.firstVertex = static_cast<std::uint32_t>(vertices);
        cluster.firstTriangle = static_cast<std::uint32_t>(triangles);
        cluster.vertexCount = in.take<std::uint8_t>() + 1U;
        cluster.triangleCount = in.take<std::uint8_t>() + 1U;
        if (info.level > 0) {
            cluster.refinement = takeIndex(in);
            if (cluster.refinement >= info.refinementCount) throw Damage{"a cluster names a refinement out of range"};
        }
        vertices += cluster.vertexCount;
        triangles += cluster.triangleCount;
        if (vertices > info.vertexCount || triangles > info.triangleCount) break;
        page.clusters.push_back(cluster);
    }
    if (vertices != info.vertexCount || triangles != info.triangleCount)
        throw Damage{"the counts of the clusters differ from the page table"};
}

/// Returns `result`, which a zstd call has returned. Throws bad_alloc if it means that memory is exhausted.
std::size_t withMemory(std::size_t result) {
    if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
    return result;
}

/// A zstd context that a thread reuses for all pages. Creating a new one would cost a tenth of the time to decode a
/// page.
template <class Context>
class KeptContext {
public:
    KeptContext(Context* (*make)(), std::size_t (*free)(Context*)) : make_(make), context_(nullptr, free) {}

    /// Returns the zstd context, which the first call creates. Throws bad_alloc if this fails.
    Context* made() {
        if (!context_) context_.reset(make_());
        if (!context_) throw std::bad_alloc();
        return context_.get();
    }

private:
    Context* (*make_)();
    std::unique_ptr<Context, std::size_t (*)(Context*)> context_;
};

/// Compresses `bytes` as a separate zstd block and appends it to `packed`, which must have enough space.
void packBlock(ZSTD_CCtx* context, std::span<const std::byte> bytes, ZSTD_EndDirective then, ZSTD_outBuffer& packed) {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    GNOMON_CHECK_OP(withMemory(ZSTD_compressStream2(context, &packed, &in, then)), ==, std::size_t{0});
}

/// Compresses `plain` to one zstd frame. Each part between two `streamEnds` becomes a separate block if it is long
/// enough. Bytes of different kinds in one block would share an entropy table that fits none of them.
std::vector<std::byte> packedFrame(std::span<const std::byte> plain, std::span<const std::size_t> streamEnds) {
    thread_local KeptContext<ZSTD_CCtx> kept(ZSTD_createCCtx, ZSTD_freeCCtx);
    ZSTD_CCtx* const context = kept.made();
    ZSTD_CCtx_reset(context, ZSTD_reset_session_and_parameters);
    ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, kCompressionLevel);
    ZSTD_CCtx_setPledgedSrcSize(context, plain.size());
    constexpr std::size_t kBlockHeader = 3;
    std::vector<std::byte> packed(ZSTD_compressBound(plain.size()) + streamEnds.size() * kBlockHeader);
    ZSTD_outBuffer out{packed.data(), packed.size(), 0};
    std::size_t begin = 0;
    for (const std::size_t end : streamEnds) {
        if (end - begin < kMinBlockBytes || plain.size() - end < kMinBlockBytes) continue;
        packBlock(context, plain.subspan(begin, end - begin), ZSTD_e_flush, out);
        begin = end;
    }
    packBlock(context, plain.subspan(begin), ZSTD_e_end, out);
    packed.resize(out.pos);
    return packed;
}

std::vector<std::byte> pack(
    std::span<const std::byte> plain, std::span<const std::size_t> streamEnds, std::uint8_t packingBits) {
    std::vector<std::byte> packed = packedFrame(plain, streamEnds);
    if (static_cast<double>(packed.size()) < kRepetitiveShare * static_cast<double>(plain.size()))
        packed = packedFrame(plain, {});
    ByteWriter out;
    const bool worthIt = packed.size() < plain.size() && plain.size() <= packed.size() * kMaxExpansion;
    const auto packing = static_cast<std::uint8_t>(worthIt ? Packing::Zstd : Packing::Plain);
    out.put(static_cast<std::uint8_t>(packing | packingBits));
    out.putVarint(plain.size());
    out.put(worthIt ? std::span<const std::byte>(packed) : plain);
    return out.take();
}

/// Returns the uncompressed bytes of a page. If decompression was necessary, they are in `storage`. `packingBits`
/// receives the bits that describe the content of the page. Throws Damage if there are more than `maxBytes` bytes.
std::span<const std::byte> unpack(
    std::span<const std::byte> stored,
    std::uint64_t maxBytes,
    std::vector<std::byte>& storage,
    std::uint8_t& packingBits) {
    ByteReader in(stored);
    const auto first = in.take<std::uint8_t>();
    packingBits = static_cast<std::uint8_t>(first & (kAttributeErrorsBit | kFieldsBit));
    const auto packing = static_cast<Packing>(first ^ packingBits);
    const std::uint64_t size = in.takeVarint();
    const auto rest = in.take(in.remaining());
    if (packing == Packing::Plain) {
        if (size != rest.size()) throw Damage{"the stored size differs from the page table"};
        return rest;
    }
    if (packing != Packing::Zstd) throw Damage{"unknown packing"};
    if (size > rest.size() * kMaxExpansion) throw Damage{"the decompressed size is too large for the stored bytes"};
    if (size > maxBytes) throw Damage{"the decompressed size is too large for the counts of the page table"};
    storage.resize(size);
    thread_local KeptContext<ZSTD_DCtx> kept(ZSTD_createDCtx, ZSTD_freeDCtx);
    const std::size_t got =
        withMemory(ZSTD_decompressDCtx(kept.made(), storage.data(), size, rest.data(), rest.size()));
    if (ZSTD_isError(got) != 0) throw Damage{std::string("cannot decompress: ") + ZSTD_getErrorName(got)};
    if (got != size) throw Damage{"the decompressed size differs from the page table"};
    return storage;
}

bool sameRow(const PageInfo& a, const PageInfo& b) {
    return a.box.min == b.box.min && a.box.max == b.box.max && a.bounds.center == b.bounds.center &&
           a.bounds.radius == b.bounds.radius && a.minError == b.minError && a.maxError == b.maxError &&
           a.children == b.children;
}

} // namespace

std::vector<std::byte> encodePageBytes(const Page& page, const PageFields& fields) {
    GNOMON_CHECK(fields.words.empty() || fields.words.size() == page.vertices.size());
    ByteWriter plain;
    const bool withAttributeErrors = hasAttributeErrors(page);
    putTables(page, withAttributeErrors, plain);
    const std::vector<std::size_t> streamEnds = encodeClusters(page, plain, fields);
    const int packingBits = (withAttributeErrors ? kAttributeErrorsBit : 0) | (fields.words.empty() ? 0 : kFieldsBit);
    return pack(plain.bytes(), streamEnds, static_cast<std::uint8_t>(packingBits));
}

Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info) {
    thread_local PageFields fields;
    return decodePageBytes(bytes, info, fields);
}

Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info, PageFields& fields) {
    if (const auto fault = countsFault(info)) throw Damage{*fault};
    thread_local std::vector<std::byte> storage; // reused to avoid an allocation per page
    std::uint8_t packingBits = 0;
    ByteReader in(unpack(bytes, maxPlainBytes(info), storage, packingBits));
    const bool withAttributeErrors = (packingBits & kAttributeErrorsBit) != 0;
    const bool withFields = (packingBits & kFieldsBit) != 0;
    if (!withFields) fields = {};
    Page page;
    page.level = info.level;
    takeGroups(in, info, withAttributeErrors, page);
    takeRefinements(in, info, withAttributeErrors, page);
    takeClusters(in, info, page);
    if (page.clusters.empty()) throw Damage{"the page has no cluster"};
    decodeClusters(in, page, withFields ? &fields : nullptr);
    in.expectEnd();
    for (Group& group : page.groups)
        for (std::uint32_t c = 0; c < group.clusterCount; ++c)
            group.box.add(page.clusters[group.firstCluster + c].box);
    if (!sameRow(describePage(page), info)) throw Damage{"bounds or errors differ from the page table"};
    return page;
}

} // namespace gnomon::hierarchy
