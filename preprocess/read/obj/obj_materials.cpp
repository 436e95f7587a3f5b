#include "preprocess/read/obj/obj_materials.h"

#include "core/error.h"
#include "core/file.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace gnomon::read {

namespace {

constexpr std::uint64_t kMostLibraryBytes = std::uint64_t{64} << 20U;
constexpr std::size_t kMostWordsOfName = 16;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::uint32_t channelOf(std::string_view word, const std::string& where) {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error != std::errc() || !std::isfinite(value))
        throw Error(where, "bad colour of a material", "three numbers from 0 to 1", quotedForMessage(word));
    return static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

/// The path of `name` in the folder of `obj`; empty where it is no file there.
std::string fileBeside(const std::string& obj, const std::string& name) {
    std::string slashed = name;
    std::replace(slashed.begin(), slashed.end(), '\\', '/'); // as Windows writes them
    const std::filesystem::path relative = std::filesystem::path(slashed).lexically_normal();
    if (relative.empty() || relative.is_absolute() || *relative.begin() == "..") return {};
    const std::filesystem::path file = std::filesystem::path(obj).parent_path() / relative;
    std::error_code missing;
    return std::filesystem::is_regular_file(file, missing) ? file.string() : std::string();
}

} // namespace

void ObjMaterials::begin() {
    materials_.clear();
    files_.clear();
    leftOut_.clear();
    color_ = 0xFFFFFFFF;
    hasColors_ = false;
}

void ObjMaterials::addLibraries(std::string_view names) {
    const std::vector<std::string_view> words = wordsOf(names);
    for (std::size_t first = 0; first < words.size();) {
        std::string found;
        std::size_t count = std::min(words.size() - first, kMostWordsOfName);
        for (; count > 0 && found.empty(); --count) {
            const std::string_view last = words[first + count - 1];
            const char* const begin = words[first].data();
            found = fileBeside(path_, {begin, static_cast<std::size_t>(last.data() + last.size() - begin)});
        }
        if (found.empty())
            ++leftOut_["material libraries that are not there"];
        else
            readLibrary(found);
        first += found.empty() ? 1 : count + 1;
    }
}

void ObjMaterials::readLibrary(const std::string& file) {
    if (std::find(files_.begin(), files_.end(), file) != files_.end()) return;
    files_.push_back(file);
    const std::string text = readTextFile(file, {kMostLibraryBytes});
    Material* material = nullptr;
    std::uint64_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
        ++number;
        const std::vector<std::string_view> words = wordsOf(line);
        if (words.empty()) continue;
        if (words[0] == "newmtl") material = &materials_[std::string(trimmed(line.substr(6)))];
        if (material == nullptr) continue;
        // "Kd spectral FILE" and "Kd xyz X Y Z" are known from the format's description alone.
        if (words[0] == "Kd" && words.size() >= 4 && words[1] != "spectral" && words[1] != "xyz") {
            const std::string where = atLine(file, number);
            material->color = 0xFF000000U | channelOf(words[1], where) | channelOf(words[2], where) << 8U |
                              channelOf(words[3], where) << 16U;
        }
        if (words[0] == "map_Kd") material->hasTexture = true;
    }
}

void ObjMaterials::use(std::string_view name) {
    const auto found = materials_.find(std::string(trimmed(name)));
    if (found == materials_.end()) {
        color_ = 0xFFFFFFFF;
        ++leftOut_["materials that no library has"];
        return;
    }
    Material& material = found->second;
    if (material.hasTexture && !material.isUsed) ++leftOut_["textures"];
    material.isUsed = true;
    color_ = material.color;
    hasColors_ |= color_ != 0xFFFFFFFF;
}

} // namespace gnomon::read
