#include "preprocess/read/off/off_header.h"

#include "core/error.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/words.h"

#include <algorithm>

namespace gnomon::read {

namespace {

class OffHeaderReader {
public:
    explicit OffHeaderReader(const InputFile& file) : file_(file), text_(file, kOffRules) {}

    OffHeader read() {
        const std::string glued = keyword(std::string(text_.wordOnAnyLine()));
        std::string first = glued.empty() ? std::string(text_.wordOnAnyLine()) : glued;
        if (first == "BINARY") {
            text_.endLine();
            header_.isBinary = true;
            header_.bodyOffset = text_.offset();
            return header_;
        }
        header_.vertices = count(first);
        header_.faces = count(std::string(text_.wordOnAnyLine()));
        edges();
        requireRoom();
        return header_;
    }

private:
    /// Parses the keyword `word` of the file, such as OFF. Returns the number of vertices if it is joined to the
    /// keyword or replaces the keyword. Otherwise returns an empty text.
    std::string keyword(std::string word) {
        if (integerIn<std::uint64_t>(word)) return word;
        if (word.starts_with("off") || word.starts_with("coff") || word.starts_with("noff") ||
            word.starts_with("cnoff") || word.starts_with("stoff"))
            std::transform(word.begin(), word.end(), word.begin(), [](char c) {
                return static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
            });
        const std::size_t off = word.find("OFF");
        if (off != std::string::npos) takeKinds(std::string_view(word).substr(0, off));
        if (off == std::string::npos || isOther_)
            throw Error(
                text_.where(),
                "not an OFF file with three coordinates per vertex",
                "OFF, with an optional prefix ST, C or N",
                quotedForMessage(word));
        return word.substr(off + 3);
    }

    /// Parses the letters before OFF in the keyword. Each letter names an attribute of the vertices, such as normals.
    void takeKinds(std::string_view kinds) {
        while (!kinds.empty()) {
            const bool isTexture = kinds.starts_with("ST");
            bool& has = isTexture              ? header_.hasTexture
                        : kinds.front() == 'C' ? header_.hasColors
                        : kinds.front() == 'N' ? header_.hasNormals
                                               : isOther_;
            has = true;
            kinds.remove_prefix(isTexture ? 2 : 1);
        }
    }

    std::uint64_t count(const std::string& word) const {
        const auto value = integerIn<std::uint64_t>(word);
        if (!value) text_.requireShort(word);
        if (!value)
            throw Error(
                text_.where(), "bad counts", "the numbers of vertices, faces and edges", quotedForMessage(word));
        return *value;
    }

    /// Skips the number of edges, which is not used. The number is on the rest of this line, or on a line with only one
    /// number.
    void edges() {
        const std::string word(text_.word());
        if (!word.empty()) {
            count(word);
            header_.bodyOffset = text_.offset();
            header_.bodyLine = text_.line() - 1;
            return;
        }
        text_.endLine();
        header_.bodyOffset = text_.offset();
        header_.bodyLine = text_.line();
        const std::string next(text_.wordOnAnyLine());
        if (!integerIn<std::uint64_t>(next) || !text_.word().empty()) return;
        text_.endLine();
        header_.bodyOffset = text_.offset();
        header_.bodyLine = text_.line();
    }

    /// Throws Error if the file is too short for the numbers of vertices and faces in its header.
    void requireRoom() const {
        constexpr std::uint64_t kVertexBytes = 6; // the shortest vertex, "0 0 0 "
        constexpr std::uint64_t kFaceBytes = 2;   // the shortest face, "0\n"
        const std::uint64_t left = file_.size() - header_.bodyOffset + 1;
        requireLimit(left / kVertexBytes, header_.vertices, "vertices");
        requireLimit((left - kVertexBytes * header_.vertices) / kFaceBytes, header_.faces, "faces");
    }

    void requireLimit(std::uint64_t max, std::uint64_t count, const std::string& rows) const {
        if (count > max)
            throw Error(
                file_.path(),
                "the file is too short for the counts of its header",
                "at most " + std::to_string(max) + " " + rows,
                std::to_string(count));
    }

    const InputFile& file_;
    TextStream text_;
    OffHeader header_;
    bool isOther_ = false; ///< whether the keyword declares an attribute that is not read
};

} // namespace

OffHeader readOffHeader(const InputFile& file) {
    return OffHeaderReader(file).read();
}

} // namespace gnomon::read
