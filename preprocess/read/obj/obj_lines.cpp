#include "preprocess/read/obj/obj_lines.h"

#include "core/check.h"
#include "core/error.h"
#include "preprocess/read/obj/obj_words.h"

#include <cmath>
#include <cstring>

namespace gnomon::read {

namespace {

constexpr std::uint64_t kStretchBytes = std::uint64_t{1} << 20U;
constexpr std::size_t kLongestObjLine = std::size_t{64} << 20U;
constexpr const char* kTexcoords = "texture coordinates";

bool isObjBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// The next word of `text`, which loses it; empty at its end.
std::string_view nextWord(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && isObjBlank(text[begin]))
        ++begin;
    std::size_t end = begin;
    while (end < text.size() && !isObjBlank(text[end]))
        ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

/// Neither a comment in it nor a sign that it goes on in the next line.
bool isPlain(std::string_view text) {
    if (std::memchr(text.data(), '#', text.size()) != nullptr) return false;
    std::size_t end = text.size();
    while (end > 0 && isObjBlank(text[end - 1]))
        --end;
    return end == 0 || text[end - 1] != '\\';
}

std::optional<ObjKind> kindOf(std::string_view keyword) {
    if (keyword == "v") return ObjKind::Vertex;
    if (keyword == "vn") return ObjKind::Normal;
    if (keyword == "f") return ObjKind::Face;
    return std::nullopt;
}

std::uint64_t placeOf(std::int32_t index, std::uint64_t count) {
    return index > 0 ? static_cast<std::uint64_t>(index) - 1 : count + static_cast<std::uint64_t>(std::int64_t{index});
}

} // namespace

ObjLines::ObjLines(const InputFile& file, std::vector<ObjStretch>* found)
    : file_(file), stream_(file, 0), guard_(file.path()), found_(found) {
    guard_.begin();
}

ObjLines::ObjLines(const InputFile& file, std::span<const ObjStretch> stretches, ObjKinds wanted)
    : file_(file), stream_(file, 0), guard_(file.path()), stretches_(stretches), wanted_(wanted) {
    guard_.begin();
}

std::string ObjLines::where() const {
    return atLine(file_.path(), lineNumber_);
}

std::map<std::string, std::uint64_t> ObjLines::leftOut() const {
    std::map<std::string, std::uint64_t> all = guard_.leftOut();
    if (texcoordLines_ > 0) all[kTexcoords] += texcoordLines_;
    return all;
}

bool ObjLines::next(ObjLine& line) {
    std::string_view text;
    while (nextText(text))
        if (take(text, line)) return true;
    guard_.end(where());
    return false;
}

/// The next line of the file without its end; valid until the next call.
bool ObjLines::nextText(std::string_view& text) {
    stream_.consume(given_);
    given_ = 0;
    if (found_ != nullptr) beginStretch();
    if (!passOver() || !stream_.fill(1)) return false;
    ++lineNumber_;
    std::size_t searched = 0;
    while (true) {
        text = {reinterpret_cast<const char*>(stream_.data()), stream_.available()};
        if (const void* const end = std::memchr(text.data() + searched, '\n', text.size() - searched)) {
            text = text.substr(0, static_cast<std::size_t>(static_cast<const char*>(end) - text.data()));
            given_ = text.size() + 1;
            return true;
        }
        searched = text.size();
        if (searched == ByteStream::kBufferBytes) return longText(text);
        if (stream_.fill(searched + 1)) continue;
        given_ = searched;
        return true;
    }
}

bool ObjLines::longText(std::string_view& text) {
    long_.clear();
    while (stream_.fill(1)) {
        const std::string_view more(reinterpret_cast<const char*>(stream_.data()), stream_.available());
        const std::size_t end = more.find('\n');
        long_ += more.substr(0, end);
        if (long_.size() > kLongestObjLine) throw Error(where(), "a line of more than 64 MiB");
        stream_.consume(end == std::string_view::npos ? more.size() : end + 1);
        if (end != std::string_view::npos) break;
    }
    text = long_;
    return true;
}

/// Where the last stretch is long enough, the next one begins, unless a line goes on in it.
void ObjLines::beginStretch() {
    if (isContinued_ || (!found_->empty() && stream_.offset() < found_->back().offset + kStretchBytes)) return;
    found_->push_back({stream_.offset(), lineNumber_, vertices_, normals_, 0});
}

/// Passes over stretches that have nothing that is wanted; false where nothing is left.
bool ObjLines::passOver() {
    while (stretch_ < stretches_.size() && stream_.offset() >= stretches_[stretch_].offset) {
        const ObjStretch& here = stretches_[stretch_++];
        if ((here.kinds & wanted_) != 0) continue;
        if (stretch_ == stretches_.size()) return false;
        const ObjStretch& after = stretches_[stretch_];
        stream_.skip(after.offset - stream_.offset());
        lineNumber_ = after.line;
        vertices_ = after.vertices;
        normals_ = after.normals;
    }
    return true;
}

/// Whether `text` is one of the lines that are told; `line` is it then.
bool ObjLines::take(std::string_view text, ObjLine& line) {
    if (!text.empty() && text[0] == '#' && !isContinued_ && isPlain(text.substr(1))) return false;
    if (isContinued_ || !isPlain(text)) return takeGuarded(text, line);
    std::string_view rest = text;
    const std::string_view keyword = nextWord(rest);
    if (keyword.empty()) return false;
    if (keyword == "vt") {
        ++texcoordLines_;
        return false;
    }
    const std::optional<ObjKind> kind = kindOf(keyword);
    if (!kind) return takeGuarded(text, line);
    if ((wanted_ & kindBit(*kind)) != 0) return takeWords(text, line) || takeGuarded(text, line);
    countVector(*kind); // it was looked at in the first pass
    return false;
}

void ObjLines::countVector(ObjKind kind) {
    if (kind == ObjKind::Vertex) ++vertices_;
    if (kind == ObjKind::Normal) ++normals_;
}

/// The slow way, which knows continued lines, comments and materials and says what is wrong with a line.
bool ObjLines::takeGuarded(std::string_view text, ObjLine& line) {
    if (found_ != nullptr) found_->back().kinds |= kindBit(ObjKind::Face);
    const std::optional<std::string> whole = guard_.pass(text, where());
    isContinued_ = guard_.isContinued();
    if (!whole) return false;
    guarded_ = *whole;
    if (takeWords(guarded_, line)) return (wanted_ & kindBit(line.kind)) != 0;
    std::string_view rest = guarded_;
    GNOMON_CHECK(nextWord(rest) == "vc"); // all else the guard has refused
    ++colorLines_;
    return false;
}

/// False where that is none of the lines that are told, or a bad one.
bool ObjLines::takeWords(std::string_view text, ObjLine& line) {
    const std::optional<ObjKind> kind = kindOf(nextWord(text));
    return kind && (*kind == ObjKind::Face ? takeFace(text, line) : takeVector(text, *kind, line));
}

bool ObjLines::takeVector(std::string_view rest, ObjKind kind, ObjLine& line) {
    for (int i = 0; i < 3; ++i) {
        const std::optional<float> number = numberIn<float>(nextWord(rest));
        if (!number || !std::isfinite(*number)) return false;
        line.vector[i] = *number;
    }
    line.vertexColor.reset();
    if (kind == ObjKind::Vertex) {
        glm::vec3 color(0);
        int channels = 0;
        for (; channels < 3; ++channels) {
            const std::optional<float> number = numberIn<float>(nextWord(rest));
            if (!number || !std::isfinite(*number)) break;
            color[channels] = *number;
        }
        if (channels == 3) line.vertexColor = color;
    }
    countVector(kind);
    line.kind = kind;
    note(kind);
    return true;
}

bool ObjLines::takeFace(std::string_view rest, ObjLine& line) {
    corners_.clear();
    for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) {
        const std::optional<ObjIndices> indices = cornerIn(word);
        if (!indices) return false;
        ObjCorner& corner = corners_.emplace_back();
        corner.vertex = placeOf(indices->vertex, vertices_);
        if (indices->normal != 0) corner.normal = placeOf(indices->normal, normals_);
    }
    line.kind = ObjKind::Face;
    line.corners = corners_;
    line.faceColor = materials().color();
    note(ObjKind::Face);
    return true;
}

void ObjLines::note(ObjKind kind) {
    if (found_ != nullptr) found_->back().kinds |= kindBit(kind);
}

} // namespace gnomon::read
