#include "preprocess/read/obj/obj_vertices.h"

#include "core/error.h"

#include <algorithm>
#include <tuple>

namespace gnomon::read {

namespace {

/// Counts of used vertices are stored at intervals of this number of vertices.
constexpr std::size_t kRankStep = 64;

/// The max memory in bytes that one entry of a growing hash table needs, including its bucket.
constexpr std::uint64_t kBytesOfOther = 64;

std::tuple<float, float, float> tupleOf(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

} // namespace

bool isObjFace(std::span<const ObjCorner> corners) {
    if (corners.size() < 3) return false;
    const std::uint64_t first = corners[0].vertex;
    const auto second =
        std::find_if(corners.begin(), corners.end(), [first](const ObjCorner& c) { return c.vertex != first; });
    if (second == corners.end()) return false;
    return std::any_of(second, corners.end(), [first, second](const ObjCorner& c) {
        return c.vertex != first && c.vertex != second->vertex;
    });
}

ObjVertices::ObjVertices(Options options, std::vector<glm::vec3> normals, std::uint64_t normalCount)
    : options_(std::move(options)), normals_(std::move(normals)), normalCount_(normalCount) {
    const auto count = static_cast<std::size_t>(options_.vertexCount);
    if (options_.hasAlignedNormals)
        hasOwnNormal_.resize(count);
    else if (!normals_.empty())
        ownNormals_.resize(count, kOwn);
    if (!options_.hasFaceColors) return;
    ownColors_.resize(count, 0xFFFFFFFF);
    isUsed_.resize(count);
}

std::uint32_t ObjVertices::ownNormal(std::uint64_t vertex) const {
    if (options_.hasAlignedNormals) return hasOwnNormal_[vertex] ? static_cast<std::uint32_t>(vertex) : kOwn;
    return ownNormals_.empty() ? kOwn : ownNormals_[vertex];
}

/// Stores the normals that the corners of `face` give to its vertices, even if the face is not a polygon.
void ObjVertices::takeNormals(const ObjLine& face) {
    for (const ObjCorner& corner : face.corners)
        if (corner.normal < normalCount_) giveNormal(corner.vertex, static_cast<std::uint32_t>(corner.normal));
}

void ObjVertices::giveNormal(std::uint64_t vertex, std::uint32_t normal) {
    hasNormals_ = true;
    if (options_.hasAlignedNormals) {
        hasOwnNormal_[vertex] = true;
        return;
    }
    std::uint32_t& own = ownNormals_[vertex];
    if (own == kOwn) own = normal;
    if (normals_[own] != normals_[normal])
        others_[vertex] = normal;
    else
        others_.erase(vertex);
    constexpr std::size_t kFew = 1U << 16U;
    if (others_.size() > kFew && (others_.size() & (kFew - 1)) == 0) requireRoom();
}

void ObjVertices::forgetOthers() {
    // A hash table with more buckets is replaced, because clearing it takes longer than reading a face.
    constexpr std::size_t kFewBuckets = 1024;
    if (others_.bucket_count() > kFewBuckets)
        others_ = std::unordered_map<std::uint64_t, std::uint32_t>();
    else if (!others_.empty())
        others_.clear();
}

ObjVariant ObjVertices::variantOf(std::uint64_t vertex, std::uint32_t color) const {
    ObjVariant variant{static_cast<std::uint32_t>(vertex), kOwn, options_.hasFaceColors ? color : 0};
    const auto found = others_.find(vertex);
    if (found != others_.end()) variant.normal = found->second;
    return variant;
}

bool ObjVertices::isOwn(const ObjVariant& variant) const {
    return variant.normal == kOwn &&
           (!options_.hasFaceColors || (isUsed_[variant.vertex] && ownColors_[variant.vertex] == variant.color));
}

/// Returns true if `a` comes before `b` in the order by vertex, then normal, then colour. Normals are compared by
/// value, not by index.
bool ObjVertices::isBefore(const ObjVariant& a, const ObjVariant& b) const {
    if (a.vertex != b.vertex) return a.vertex < b.vertex;
    if ((a.normal == kOwn) != (b.normal == kOwn)) return a.normal == kOwn;
    if (a.normal != kOwn && normals_[a.normal] != normals_[b.normal])
        return tupleOf(normals_[a.normal]) < tupleOf(normals_[b.normal]);
    return a.color < b.color;
}

void ObjVertices::add(const ObjLine& face) {
    takeNormals(face);
    if (!isObjFace(face.corners)) return;
    for (const ObjCorner& corner : face.corners) {
        const ObjVariant variant = variantOf(corner.vertex, face.faceColor);
        if (options_.hasFaceColors && variant.normal == kOwn && !isUsed_[corner.vertex]) {
            isUsed_[corner.vertex] = true;
            ownColors_[corner.vertex] = variant.color;
        }
        if (!isOwn(variant)) variants_.push_back(variant);
    }
    forgetOthers();
    constexpr std::size_t kFew = 1U << 20U;
    if (variants_.size() > 2 * compacted_ + kFew) compact();
}

void ObjVertices::compact() {
    const auto isLess = [this](const ObjVariant& a, const ObjVariant& b) { return isBefore(a, b); };
    std::sort(variants_.begin(), variants_.end(), isLess);
    const auto isSame = [this](const ObjVariant& a, const ObjVariant& b) { return !isBefore(a, b); };
    variants_.erase(std::unique(variants_.begin(), variants_.end(), isSame), variants_.end());
    compacted_ = variants_.size();
    requireRoom();
}

void ObjVertices::finish() {
    forgetOthers();
    compact();
    variants_.shrink_to_fit();
    firstVariant_ = options_.vertexCount;
    if (!options_.hasFaceColors) return;
    std::uint64_t used = 0;
    for (std::size_t vertex = 0; vertex < isUsed_.size(); ++vertex) {
        if (vertex % kRankStep == 0) usedBefore_.push_back(used);
        used += isUsed_[vertex] ? 1 : 0;
    }
    firstVariant_ = used;
}

std::span<const std::uint64_t> ObjVertices::cornersOf(const ObjLine& face) {
    if (!ownNormals_.empty()) takeNormals(face);
    corners_.clear();
    if (!isObjFace(face.corners)) return {};
    for (const ObjCorner& corner : face.corners) {
        const ObjVariant variant = variantOf(corner.vertex, face.faceColor);
        if (!isOwn(variant)) {
            const auto found = std::lower_bound(
                variants_.begin(), variants_.end(), variant, [this](const ObjVariant& a, const ObjVariant& b) {
                    return isBefore(a, b);
                });
            corners_.push_back(firstVariant_ + static_cast<std::uint64_t>(found - variants_.begin()));
        } else if (!options_.hasFaceColors) {
            corners_.push_back(corner.vertex);
        } else {
            std::uint64_t place = usedBefore_[corner.vertex / kRankStep];
            for (std::uint64_t v = corner.vertex / kRankStep * kRankStep; v < corner.vertex; ++v)
                place += isUsed_[v] ? 1 : 0;
            corners_.push_back(place);
        }
    }
    forgetOthers();
    return corners_;
}

std::uint64_t ObjVertices::ofFile(std::uint64_t vertex) const {
    if (vertex >= firstVariant_) return variants_[vertex - firstVariant_].vertex;
    if (!options_.hasFaceColors) return vertex;
    std::uint64_t used = 0;
    for (std::size_t v = 0; v < isUsed_.size(); ++v)
        if (isUsed_[v] && used++ == vertex) return v;
    return isUsed_.size();
}

std::uint64_t ObjVertices::heldBytes() const {
    return normals_.capacity() * sizeof(glm::vec3) + hasOwnNormal_.capacity() / 8 +
           (ownNormals_.capacity() + ownColors_.capacity()) * sizeof(std::uint32_t) + isUsed_.capacity() / 8 +
           usedBefore_.capacity() * sizeof(std::uint64_t) + variants_.capacity() * sizeof(ObjVariant) +
           others_.size() * kBytesOfOther;
}

void ObjVertices::requireRoom() const {
    if (heldBytes() > options_.memoryLimit.count)
        throw Error(
            options_.path,
            "too many vertices have several normals or colours; convert the file to PLY",
            "at most " + readableBytes(options_.memoryLimit) + " of memory",
            "a need for more than " + readableBytes({heldBytes()}));
}

} // namespace gnomon::read
