#include "preprocess/read/line_guards.h"

#include "core/error.h"
#include "preprocess/read/obj/obj_words.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gnomon::read {

namespace {

std::string_view withoutComment(std::string_view line) {
    return line.substr(0, line.find('#'));
}

// `count` words from `first` on must be numbers that a float can hold.
void expectNumbers(
    const std::vector<std::string_view>& words, std::size_t first, std::size_t count, const std::string& where) {
    if (words.size() < first + count)
        throw Error(
            where,
            "too few numbers",
            std::to_string(count),
            std::to_string(words.size() - std::min(first, words.size())));
    for (std::size_t i = first; i < first + count; ++i) {
        const std::optional<float> number = numberIn<float>(words[i]);
        if (!number || !std::isfinite(*number))
            throw Error(where, "bad number", "a finite one", quotedForMessage(words[i]));
    }
}

std::string joined(const std::vector<std::string_view>& words, std::size_t first, std::size_t end) {
    std::string line;
    for (std::size_t i = first; i < end; ++i) {
        if (i > first) line += ' ';
        line += words[i];
    }
    return line;
}

void expectCorners(const std::vector<std::string_view>& line, const std::string& where) {
    const auto bad = std::find_if(line.begin() + 1, line.end(), [](std::string_view word) { return !cornerIn(word); });
    if (bad != line.end())
        throw Error(where, "bad corner of a face", "V, V/T, V//N or V/T/N with V not 0", quotedForMessage(*bad));
}

/// Where in `line` a word is no number, behind its three coordinates: OpenMesh would take the digits that it begins
/// with for a channel of a colour.
std::size_t endOfNumbers(const std::string& line, const std::vector<std::string_view>& words) {
    for (std::size_t i = 4; i < words.size(); ++i) {
        const std::optional<float> number = numberIn<float>(words[i]);
        if (!number || !std::isfinite(*number)) return static_cast<std::size_t>(words[i].data() - line.data());
    }
    return line.size();
}

} // namespace

void ObjGuard::begin() {
    materials_.begin();
    faceLines_ = 0;
    vertexLines_ = 0;
    continued_.clear();
    leftOut_.clear();
}

std::optional<std::string> ObjGuard::pass(std::string_view line, const std::string& where) {
    continued_ += withoutComment(line);
    const std::size_t last = continued_.find_last_not_of(" \t\r");
    if (last != std::string::npos && continued_[last] == '\\') {
        continued_.resize(last);
        continued_ += ' ';
        return std::nullopt;
    }
    std::string whole = std::exchange(continued_, {});
    const std::vector<std::string_view> words = wordsOf(whole);
    if (words.empty()) return std::nullopt;
    if (words[0] == "f") {
        takeFace(words, where);
        return whole;
    }
    if (words[0] != "v" && words[0] != "vn" && words[0] != "vc") {
        constexpr std::array<std::pair<std::string_view, const char*>, 3> kNamed = {
            {{"vt", "texture coordinates"}, {"l", "lines"}, {"p", "points"}}};
        for (const auto& [keyword, name] : kNamed)
            if (words[0] == keyword) ++leftOut_[name];
        tellMaterials(
            std::string_view(words[0].data(), static_cast<std::size_t>(whole.data() + whole.size() - words[0].data())));
        return std::nullopt;
    }
    expectNumbers(words, 1, 3, where);
    if (words[0] == "v") ++vertexLines_;
    whole.resize(endOfNumbers(whole, words));
    return whole;
}

void ObjGuard::takeFace(const std::vector<std::string_view>& words, const std::string& where) {
    expectCorners(words, where);
    ++faceLines_;
    corners_.clear();
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::int64_t index = numberIn<std::int32_t>(words[i].substr(0, words[i].find('/'))).value_or(0);
        // Below 0 it counts back from the last vertex so far; what goes back too far wraps, and is beyond any end.
        corners_.push_back(
            index > 0 ? static_cast<std::uint64_t>(index - 1) : vertexLines_ + static_cast<std::uint64_t>(index));
    }
}

void ObjGuard::tellMaterials(std::string_view line) {
    if (line.starts_with("mtllib ")) materials_.addLibraries(line.substr(7));
    if (line.starts_with("usemtl ")) materials_.use(line.substr(7));
}

void ObjGuard::end(const std::string& where) {
    if (!continued_.empty()) throw Error(where, "the file ends inside a continued line");
}

std::optional<std::string> StlGuard::pass(std::string_view line, const std::string& where) {
    constexpr std::array<std::string_view, 7> kLeftOut = {
        "solid", "facet", "endloop", "endfacet", "endsolid", "color", "normal"};
    std::string whole(line);
    for (char& c : whole)
        c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    const std::vector<std::string_view> words = wordsOf(whole);
    if (words.empty()) return std::nullopt;
    if (words[0] == "vertex") {
        expectNumbers(words, 1, 3, where);
        if (verticesToCome_ == 0) throw Error(where, "a vertex outside of a loop, or the fourth of one");
        --verticesToCome_;
        return whole;
    }
    if (verticesToCome_ > 0) throw Error(where, "bad loop", "three vertices", quotedForMessage(words[0]));
    if (words[0] == "outer") {
        ++facets_;
        verticesToCome_ = 3;
        return "outer loop";
    }
    if (std::find(kLeftOut.begin(), kLeftOut.end(), words[0]) == kLeftOut.end())
        throw Error(where, "not a line of an STL file: " + quotedForMessage(words[0]));
    if (words[0] == "solid") isInSolid_ = true;
    if (words[0] == "endsolid") isInSolid_ = false;
    return std::nullopt;
}

void StlGuard::end(const std::string& where) {
    if (verticesToCome_ > 0 || isInSolid_) throw Error(where, "the file ends too early: no endsolid");
}

std::optional<std::string> OffGuard::pass(std::string_view line, const std::string& where) {
    const std::vector<std::string_view> words = wordsOf(withoutComment(line));
    if (words.empty()) return std::nullopt;
    if (!hasHeader_) {
        hasHeader_ = true;
        hasTexcoords_ = words[0].starts_with("ST");
        hasColors_ = words[0].find('C') != std::string_view::npos;
        hasNormals_ = words[0].find('N') != std::string_view::npos;
        if (words.size() == 1) return std::string(words[0]);
        readCounts({words.begin() + 1, words.end()}, where);
        return std::string(words[0]) + "\n" + joined(words, 1, words.size());
    }
    if (!hasCounts_) {
        readCounts(words, where);
        return joined(words, 0, words.size());
    }
    if (verticesToCome_ > 0) return vertex(words, where);
    if (facesToCome_ > 0) return face(words, where);
    throw Error(where, "data after the last face: the counts are too small");
}

void OffGuard::readCounts(const std::vector<std::string_view>& words, const std::string& where) {
    const bool areThree = words.size() == 3 && numberIn<std::uint32_t>(words[2]);
    const auto vertices = numberIn<std::uint32_t>(words[0]);
    const auto faces = numberIn<std::uint32_t>(words.size() > 1 ? words[1] : "");
    if (!areThree || !vertices || !faces)
        throw Error(
            where, "bad counts", "the numbers of vertices, faces and edges", quotedForMessage(words[0]) + "...");
    hasCounts_ = true;
    verticesToCome_ = *vertices;
    facesToCome_ = *faces;
}

std::string OffGuard::vertex(const std::vector<std::string_view>& words, const std::string& where) {
    --verticesToCome_;
    const std::size_t numbers = hasNormals_ ? 6 : 3;
    expectNumbers(words, 0, numbers, where);
    const std::size_t rest = words.size() - numbers - (hasTexcoords_ ? 2 : 0);
    if (words.size() < numbers + (hasTexcoords_ ? 2 : 0) || (rest != 0 && rest != 3 && rest != 4 && hasColors_))
        throw Error(where, "bad vertex", "a colour of three or four channels", std::to_string(rest) + " values");
    expectNumbers(words, numbers, hasColors_ ? rest : 0, where);
    return joined(words, 0, words.size());
}

std::string OffGuard::face(const std::vector<std::string_view>& words, const std::string& where) {
    --facesToCome_;
    const auto size = numberIn<std::uint32_t>(words[0]);
    if (!size || *size >= words.size())
        throw Error(
            where, "bad face", "a number of corners and as many indices", std::to_string(words.size()) + " words");
    for (std::size_t i = 1; i <= *size; ++i)
        if (!numberIn<std::int32_t>(words[i])) throw Error(where, "bad face", "an index", quotedForMessage(words[i]));
    if (words.size() > *size + 1) ++coloredFaces_;
    return joined(words, 0, *size + 1);
}

void OffGuard::end(const std::string& where) {
    if (!hasCounts_ || verticesToCome_ > 0 || facesToCome_ > 0)
        throw Error(
            where,
            "the file ends too early",
            std::to_string(verticesToCome_) + " more vertices and " + std::to_string(facesToCome_) + " more faces",
            "the end");
}

} // namespace gnomon::read
