#include "preprocess/scratch/parted_scratch.h"

#include "core/check.h"
#include "preprocess/scratch/damage_error.h"

#include <filesystem>

namespace gnomon::scratch {

namespace {

constexpr std::uint64_t kOffsetMask = (std::uint64_t{1} << kPartShift) - 1;

std::uint64_t offsetOf(std::uint64_t place) {
    return place & kOffsetMask;
}

} // namespace

std::string partPath(const std::string& stem, std::uint32_t part) {
    return stem + std::to_string(part);
}

PartedScratch::PartedScratch(std::string stem, std::uint32_t ownPart, TemporarySpace& space)
    : ScratchFile(space, placeOf(ownPart, 0)),
      stem_(std::move(stem)),
      ownPart_(ownPart),
      own_(partPath(stem_, ownPart), File::Mode::Create) {
    GNOMON_CHECK_OP(ownPart, <, kMaxParts);
}

void PartedScratch::resume(std::uint32_t part, std::uint64_t bytes) {
    const std::string path = partPath(stem_, part);
    if (!std::filesystem::exists(path)) throw DamageError(path, "the temporary file is missing");
    File file(path, File::Mode::Update);
    if (const std::uint64_t found = file.size(); found < bytes)
        throw DamageError(
            path, "the temporary file was cut off", std::to_string(bytes) + " bytes", std::to_string(found));
    file.resize(bytes);
    space().take(bytes);
}

void PartedScratch::sync(std::span<const std::uint32_t> parts) {
    for (const std::uint32_t part : parts)
        if (part == ownPart_)
            own_.sync();
        else
            other(part)->sync();
}

void PartedScratch::handOver() const {
    own_.handOver();
}

void PartedScratch::reopenOthers() {
    const std::scoped_lock lock(mutex_);
    others_.clear(); // a thread that is reading such a file keeps it open until the read ends
}

std::shared_ptr<File> PartedScratch::other(std::uint32_t part) const {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<File>& file = others_[part];
    if (!file) file = std::make_shared<File>(partPath(stem_, part), File::Mode::Update);
    return file;
}

void PartedScratch::load(std::uint64_t place, std::span<std::byte> out) const {
    if (partOf(place) == ownPart_)
        loadFrom(own_, offsetOf(place), out);
    else
        loadFrom(*other(partOf(place)), offsetOf(place), out);
}

void PartedScratch::store(std::uint64_t place, std::span<const std::byte> bytes) {
    GNOMON_CHECK_OP(partOf(place), ==, ownPart_);
    own_.writeAt(offsetOf(place), bytes);
}

void PartedScratch::forget(std::uint64_t place, std::uint64_t bytes) {
    if (partOf(place) == ownPart_)
        own_.release(offsetOf(place), bytes);
    else
        other(partOf(place))->release(offsetOf(place), bytes);
}

std::string PartedScratch::placeText(std::uint64_t place) const {
    return atByte(partPath(stem_, partOf(place)), offsetOf(place));
}

} // namespace gnomon::scratch
