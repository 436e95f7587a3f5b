#include "preprocess/read/input_file.h"

#include "core/error.h"

#include <algorithm>
#include <filesystem>

namespace gnomon::read {

namespace {

constexpr const char* kChanged = "the input changed while it was read";

const char* nameOf(std::filesystem::file_type type) {
    switch (type) {
    case std::filesystem::file_type::fifo:
        return "a pipe";
    case std::filesystem::file_type::socket:
        return "a socket";
    default:
        return "a device";
    }
}

} // namespace

void requireRereadable(const std::string& path) {
    using Type = std::filesystem::file_type;
    std::error_code ignored;
    const Type type = std::filesystem::status(path, ignored).type();
    // A missing file and a folder are not rejected here. Opening them later throws a more precise Error.
    const bool isSomethingElse =
        type == Type::fifo || type == Type::socket || type == Type::character || type == Type::block;
    if (isSomethingElse)
        throw Error(path, "a source must be a file, because it is read several times", "a file", nameOf(type));
}

InputFile::InputFile(const std::string& path)
    : file_(path, File::Mode::Read), size_(file_.size()), changeTime_(file_.changeTime()) {}

std::size_t InputFile::readSomeAt(std::uint64_t offset, std::span<std::byte> out) const {
    if (progress_ != nullptr) progress_->advance(0);
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(size_ - std::min(size_, offset), out.size()));
    const std::size_t got = file_.readSomeAt(offset, out.first(count));
    if (got < count)
        throw Error(
            atByte(path(), offset + got), kChanged, std::to_string(size_) + " bytes", std::to_string(file_.size()));
    return got;
}

void InputFile::readAt(std::uint64_t offset, std::span<std::byte> out) const {
    const std::size_t got = readSomeAt(offset, out);
    if (got < out.size())
        throw Error(
            atByte(path(), offset + got),
            "the file ends too early",
            std::to_string(out.size() - got) + " more bytes",
            "the end");
}

void InputFile::requireUnchanged() const {
    if (file_.size() != size_)
        throw Error(path(), kChanged, std::to_string(size_) + " bytes", std::to_string(file_.size()));
    if (file_.changeTime() != changeTime_) throw Error(path(), kChanged, "no writing to it", "a later time of change");
}

} // namespace gnomon::read
