#include "preprocess/read/obj/obj_materials.h"

#include "core/error.h"
#include "core/file.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/text/text_stream.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <cmath>

namespace gnomon::read {

namespace {

constexpr std::uint64_t kMaxLibraryBytes = std::uint64_t{64} << 20U;
constexpr std::size_t kMaxRejectedNames = 64; ///< a 64-bit mask has one bit per name
constexpr std::size_t kMaxUnknownNames = 4096;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::uint32_t channelOf(std::string_view word, const std::string& where) {
    const std::optional<double> value = numberIn(word);
    if (!value || !std::isfinite(*value))
        throw Error(where, "bad colour of a material", "three numbers from 0 to 1", quotedForMessage(word));
    return static_cast<std::uint32_t>(std::lround(255 * std::clamp(*value, 0.0, 1.0)));
}

/// Returns the material name `name` without a comment. A comment begins at a '#' after a blank or a tab.
std::string withoutComment(const std::string& name) {
    for (std::size_t at = name.find('#'); at != std::string::npos; at = name.find('#', at + 1))
        if (at > 0 && (name[at - 1] == ' ' || name[at - 1] == '\t'))
            return std::string(trimmed(std::string_view(name).substr(0, at)));
    return name;
}

} // namespace

void ObjMaterials::addLibraries(std::string_view names, const std::string& where) {
    const LibraryFinder::Found found = finder_.filesOf(names, where);
    if (found.missing > 0) rejected_["material libraries that are not there"] += found.missing;
    for (const std::string& file : found.files)
        readLibrary(file);
    if (found.files.empty()) return;
    std::erase_if(unknown_, [this](const auto& use) { return useKnown(use.first); });
}

void ObjMaterials::readLibrary(const std::string& file) {
    if (std::find(files_.begin(), files_.end(), file) != files_.end()) return;
    files_.push_back(file);
    const InputFile opened(file);
    requireUtf8(opened);
    const std::string text = readTextFile(file, {kMaxLibraryBytes});
    Material* material = nullptr;
    std::uint64_t number = 0;
    const bool isOldMac = text.find('\n') == std::string::npos;
    for (std::size_t begin = markBytesOf(opened); begin < text.size();) {
        const std::uint64_t first = number + 1;
        std::string line;
        for (bool isContinued = true; isContinued && begin < text.size(); ++number) {
            const std::size_t end = std::min(text.find(isOldMac ? '\r' : '\n', begin), text.size());
            const std::string_view part = trimmed(std::string_view(text).substr(begin, end - begin));
            line += part;
            begin = end + 1;
            // In a material library, a backslash at the end of a line joins it with the next line, as in an OBJ file.
            isContinued = part.ends_with('\\') && part.find('#') == std::string_view::npos;
            if (isContinued) line.back() = ' ';
        }
        const std::vector<std::string_view> words = wordsOf(line);
        if (words.empty() || words[0].starts_with('#')) continue;
        if (lowered(words[0]) == "newmtl")
            material = &declared(std::string(trimmed(std::string_view(line).substr(words[0].size()))));
        else if (material != nullptr)
            readStatement(*material, words, atLine(file, first));
    }
}

ObjMaterials::Material& ObjMaterials::declared(const std::string& name) {
    if (const std::string shortName = withoutComment(name); shortName != name) fullNames_.try_emplace(shortName, name);
    return materials_[name];
}

void ObjMaterials::readStatement(
    Material& material, const std::vector<std::string_view>& words, const std::string& where) {
    if (lowered(words[0]) != "kd") return reject(material, std::string(words[0]));
    // The statements "Kd spectral FILE" and "Kd xyz X Y Z" are not read, because they occur only in the description of
    // the format.
    if (words.size() > 1 && (words[1] == "spectral" || words[1] == "xyz"))
        return reject(material, "Kd " + std::string(words[1]));
    std::size_t count = 1;
    while (count < words.size() && !words[count].starts_with('#'))
        ++count;
    if (count != 2 && count < 4)
        throw Error(where, "bad colour of a material", "one number or three", std::to_string(count - 1));
    const std::uint32_t red = channelOf(words[1], where);
    const std::uint32_t green = count == 2 ? red : channelOf(words[2], where); // a single number is a grey level
    const std::uint32_t blue = count == 2 ? red : channelOf(words[3], where);
    material.color = 0xFF000000U | red | green << 8U | blue << 16U;
}

/// Records that the definition of `material` contains the statement `statement`, which Gnomon does not read.
void ObjMaterials::reject(Material& material, const std::string& statement) {
    const std::string name = lowered(statement) == "map_kd" ? "textures"
                             : isPlainName(statement)       ? "material " + statement
                                                            : rejectedNames_.front();
    auto found = std::find(rejectedNames_.begin(), rejectedNames_.end(), name);
    if (found == rejectedNames_.end())
        found = rejectedNames_.size() < kMaxRejectedNames ? rejectedNames_.insert(found, name) : rejectedNames_.begin();
    material.rejected |= std::uint64_t{1} << static_cast<std::size_t>(found - rejectedNames_.begin());
}

template <class Materials>
auto ObjMaterials::materialIn(Materials& materials, const std::string& name) const {
    auto found = materials.find(name);
    const std::string shortName = found == materials.end() ? withoutComment(name) : name;
    if (found == materials.end()) found = materials.find(shortName);
    if (const auto full = fullNames_.find(shortName); found == materials.end() && full != fullNames_.end())
        found = materials.find(full->second);
    return found == materials.end() ? nullptr : &found->second;
}

void ObjMaterials::use(const std::string& name) {
    if (useKnown(name)) return;
    if (unknown_.size() < kMaxUnknownNames || unknown_.contains(name))
        ++unknown_[name];
    else
        ++missing_;
}

bool ObjMaterials::useKnown(const std::string& name) {
    Material* const material = materialIn(materials_, name);
    if (material == nullptr) return false;
    for (std::size_t i = 0; i < rejectedNames_.size() && !material->isUsed; ++i)
        if ((material->rejected >> i & 1U) != 0) ++rejected_[rejectedNames_[i]];
    material->isUsed = true;
    hasColors_ |= material->color != 0xFFFFFFFF;
    return true;
}

std::uint32_t ObjMaterials::colorOf(const std::string& name) const {
    const Material* const material = materialIn(materials_, name);
    return material == nullptr ? 0xFFFFFFFF : material->color;
}

std::map<std::string, std::uint64_t> ObjMaterials::rejected() const {
    std::map<std::string, std::uint64_t> all = rejected_;
    std::uint64_t missing = missing_;
    for (const auto& [name, uses] : unknown_)
        missing += uses;
    if (missing > 0) all["materials that no library has"] += missing;
    return all;
}

} // namespace gnomon::read
