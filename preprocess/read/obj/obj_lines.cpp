#include "preprocess/read/obj/obj_lines.h"

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/obj/obj_words.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::read {

namespace {

constexpr std::uint64_t kStretchBytes = std::uint64_t{1} << 20U;

constexpr TextStream::Rules kObjRules{.hasComments = true, .isContinuable = true};

std::optional<ObjKind> kindOf(std::string_view keyword) {
    if (keyword == "v") return ObjKind::Vertex;
    if (keyword == "vn") return ObjKind::Normal;
    if (keyword == "f" || keyword == "fo") return ObjKind::Face; // version 2.11 of the OBJ format used fo for faces
    if (keyword == "vc") return ObjKind::Color;
    return std::nullopt;
}

std::uint64_t countedFromZero(std::int32_t index, std::uint64_t count) {
    return index > 0 ? static_cast<std::uint64_t>(index) - 1 : count + static_cast<std::uint64_t>(std::int64_t{index});
}

/// Keywords of OBJ lines that Gnomon does not read, with the names under which the lines are counted.
constexpr std::array<std::pair<std::string_view, const char*>, 26> kOtherLines = {{
    {"vt", "texture coordinates"},
    {"l", "lines"},
    {"p", "points"},
    {"g", "names of groups"},
    {"o", "names of objects"},
    {"s", "smoothing groups"},
    {"mg", "merging groups"},
    {"vp", "free-form surfaces"},
    {"deg", "free-form surfaces"},
    {"bmat", "free-form surfaces"},
    {"step", "free-form surfaces"},
    {"cstype", "free-form surfaces"},
    {"curv", "free-form surfaces"},
    {"curv2", "free-form surfaces"},
    {"surf", "free-form surfaces"},
    {"parm", "free-form surfaces"},
    {"trim", "free-form surfaces"},
    {"hole", "free-form surfaces"},
    {"scrv", "free-form surfaces"},
    {"sp", "free-form surfaces"},
    {"end", "free-form surfaces"},
    {"con", "free-form surfaces"},
    {"usemap", "textures of faces"},
    {"maplib", "textures of faces"},
    {"lod", "levels of detail"},
    {"shadow_obj", "objects of shadows"},
}};

} // namespace

ObjLines::ObjLines(const InputFile& file, ObjMaterials& materials, ObjSurvey& survey)
    : text_(file, kObjRules), materials_(materials), libraries_(&materials), survey_(&survey) {}

ObjLines::ObjLines(const InputFile& file, const ObjMaterials& materials, const ObjSurvey& survey, ObjKinds wanted)
    : text_(file, kObjRules), materials_(materials), stretches_(survey.stretches), wanted_(wanted) {}

bool ObjLines::next(ObjLine& line) {
    while (true) {
        text_.endLine();
        if (!passOver() || !text_.nextLine()) return false;
        if (survey_ != nullptr) beginStretch();
        const std::string_view keyword = text_.word();
        if (!keyword.empty() && take(keyword, line)) return true;
    }
}

/// Begins a new range of lines at the current line if the last range is long enough (kStretchBytes).
void ObjLines::beginStretch() {
    const std::uint64_t offset = text_.offset();
    if (!survey_->stretches.empty() && offset < survey_->stretches.back().offset + kStretchBytes) return;
    survey_->stretches.push_back({offset, text_.line() - 1, vertices_, normals_, 0});
}

/// Skips ranges of lines that contain no wanted kind of line. Returns false if no range remains.
bool ObjLines::passOver() {
    if (stretch_ == stretches_.size()) return true;
    while (stretch_ < stretches_.size() && text_.offset() >= stretches_[stretch_].offset) {
        const ObjStretch& here = stretches_[stretch_++];
        if ((here.kinds & wanted_) != 0) continue;
        if (stretch_ == stretches_.size()) return false;
        const ObjStretch& after = stretches_[stretch_];
        text_.moveTo(after.offset, after.line);
        vertices_ = after.vertices;
        normals_ = after.normals;
    }
    return true;
}

/// Parses the rest of a line that begins with `keyword`. If the line has a wanted kind, the function stores it in
/// `line` and returns true.
bool ObjLines::take(std::string_view keyword, ObjLine& line) {
    const std::optional<ObjKind> kind = kindOf(keyword);
    if (!kind) {
        if (keyword == "usemtl")
            takeMaterial();
        else if (survey_ != nullptr)
            surveyOther(keyword);
        return false;
    }
    if ((wanted_ & kindBit(*kind)) == 0) { // the first pass has already checked the line
        countVector(*kind);
        return false;
    }
    line.kind = *kind;
    if (*kind == ObjKind::Face)
        takeFace(line);
    else
        takeVector(*kind, line);
    note(*kind);
    return true;
}

void ObjLines::countVector(ObjKind kind) {
    if (kind == ObjKind::Vertex) ++vertices_;
    if (kind == ObjKind::Normal) ++normals_;
}

void ObjLines::takeVector(ObjKind kind, ObjLine& line) {
    for (int i = 0; i < 3; ++i) {
        const std::string_view word = text_.word();
        if (word.empty()) throw Error(where(), "too few numbers", "3", std::to_string(i));
        const std::optional<double> any = kind == ObjKind::Normal ? numberIn(word) : std::nullopt;
        line.vector[i] = any ? *any : text_.numberOf(word); // only a normal may be infinite
    }
    countVector(kind);
    if (kind == ObjKind::Vertex) takeVertexColor(line);
}

/// Reads the words after the coordinates of a vertex: a weight, or three colour channels and an alpha. Stops at the
/// first word that is not a finite number.
void ObjLines::takeVertexColor(ObjLine& line) {
    line.vertexColor.reset();
    std::array<double, 4> values{};
    std::size_t count = 0;
    for (std::string_view word = text_.word(); !word.empty() && count < values.size(); word = text_.word()) {
        const std::optional<double> value = numberIn(word);
        if (!value || !std::isfinite(*value)) break;
        values[count++] = *value;
    }
    if (count >= 3) line.vertexColor = glm::dvec3(values[0], values[1], values[2]);
    if (survey_ == nullptr || count == 0) return;
    if (count == 4 && values[3] != 1) ++survey_->attributesDropped["alpha"];
    if (count < 3 && values[0] != 1) ++survey_->attributesDropped["weights of vertices"];
}

void ObjLines::takeFace(ObjLine& line) {
    corners_.clear();
    for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
        const std::optional<ObjIndices> indices = cornerIn(word);
        if (!indices) text_.requireShort(word);
        if (!indices)
            throw Error(where(), "bad corner of a face", "V, V/T, V//N or V/T/N with V not 0", quotedForMessage(word));
        if (corners_.size() == kMaxPolygonCorners)
            throw Error(
                where(),
                "the face has too many corners",
                "at most " + std::to_string(kMaxPolygonCorners) + " corners",
                "more");
        ObjCorner& corner = corners_.emplace_back();
        corner.vertex = countedFromZero(indices->vertex, vertices_);
        if (indices->normal != 0) corner.normal = countedFromZero(indices->normal, normals_);
    }
    line.corners = corners_;
    line.faceColor = color_;
}

void ObjLines::takeMaterial() {
    if ((wanted_ & kindBit(ObjKind::Face)) == 0) return;
    const std::string name = text_.rest();
    if (libraries_ != nullptr) libraries_->use(name);
    color_ = materials_.colorOf(name);
    note(ObjKind::Face);
}

/// Parses a `mtllib` line, which names material libraries. Counts any other line as not read.
void ObjLines::surveyOther(std::string_view keyword) {
    if (keyword == "mtllib") {
        const std::string names = text_.rest();
        return libraries_->addLibraries(names, where());
    }
    const auto* const known =
        std::find_if(kOtherLines.begin(), kOtherLines.end(), [&](const auto& entry) { return entry.first == keyword; });
    if (keyword == "s") {
        const std::string_view group = text_.word();
        if (group.empty() || group == "off" || group == "0") return;
    }
    if (known != kOtherLines.end())
        ++survey_->attributesDropped[known->second];
    else
        countUnknown(keyword);
}

/// Counts a line whose keyword is not defined by the OBJ format, such as F.
void ObjLines::countUnknown(std::string_view keyword) {
    constexpr std::size_t kMaxNames = 64;
    const std::string name(keyword);
    std::map<std::string, std::uint64_t>& names = survey_->unknownKeywords;
    if (names.contains(name) || (isPlainName(name) && names.size() < kMaxNames))
        ++names[name];
    else
        ++survey_->attributesDropped["other lines"];
}

void ObjLines::note(ObjKind kind) {
    if (survey_ != nullptr) survey_->stretches.back().kinds |= kindBit(kind);
}

} // namespace gnomon::read
