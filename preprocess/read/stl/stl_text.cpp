#include "preprocess/read/stl/stl_text.h"

#include "core/error.h"
#include "preprocess/read/stl/stl_facets.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <optional>

namespace gnomon::read {

namespace {

/// Returns true if `word` is equal to `keyword`, in upper or lower case. `keyword` must be in lower case.
bool isKeyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
    });
}

class StlText {
public:
    explicit StlText(const InputFile& file) : text_(file, {}) {}

    MemoryMesh read() {
        for (std::string_view word = text_.wordOnAnyLine(); !word.empty();) {
            const std::string_view unused = statement(word);
            word = unused.empty() ? text_.wordOnAnyLine() : unused;
        }
        if (cornerCount_ < 3 || isInSolid_) throw Error(text_.where(), "the file ends too early: no endsolid");
        MemoryMesh mesh = facets_.take();
        if (colors_ > 0) mesh.attributesDropped["colours of facets in ASCII"] = colors_;
        return mesh;
    }

private:
    /// Parses the STL statement that begins with `word`. Returns a word that belongs to the next statement but was
    /// already read. Otherwise returns an empty word.
    std::string_view statement(std::string_view word) {
        if (isKeyword(word, "vertex")) return vertex();
        if (cornerCount_ < 3) throw Error(text_.where(), "bad loop", "three vertices", quotedForMessage(word));
        if (isKeyword(word, "normal")) return normal();
        if (isKeyword(word, "color")) {
            ++colors_;
            glm::dvec4 color(0);
            return numbers(color);
        }
        if (isKeyword(word, "solid") || isKeyword(word, "endsolid")) {
            isInSolid_ = isKeyword(word, "solid");
            return restOfName();
        }
        if (isKeyword(word, "outer")) {
            cornerCount_ = 0;
            const std::string_view next = text_.wordOnAnyLine();
            return isKeyword(next, "loop") ? std::string_view() : next;
        }
        text_.requireShort(word);
        constexpr std::array<std::string_view, 3> kOthers = {"facet", "endloop", "endfacet"};
        if (std::none_of(kOthers.begin(), kOthers.end(), [&](auto keyword) { return isKeyword(word, keyword); }))
            throw Error(text_.where(), "unknown STL keyword: " + quotedForMessage(word));
        return {};
    }

    /// Skips the name of a solid up to the end of the line. If the file has only one line, the function also stops at
    /// words that cannot be part of a name. Returns a word that belongs to the next statement, or an empty word.
    std::string_view restOfName() {
        bool isAfterFacet = false;
        for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
            if (isAfterFacet && isKeyword(word, "normal")) {
                isInSolid_ = true;
                return normal();
            }
            isAfterFacet = isKeyword(word, "facet");
            if (isKeyword(word, "endsolid")) isInSolid_ = false;
        }
        return {};
    }

    /// Parses numbers into `values`. At a word that is not a number, the function stops and returns this word.
    /// Otherwise it returns an empty word.
    template <class Vector>
    std::string_view numbers(Vector& values) {
        for (int i = 0; i < Vector::length(); ++i) {
            const std::string_view word = text_.wordOnAnyLine();
            const std::optional<double> value = numberIn(word);
            if (!value) return word;
            values[i] = *value;
        }
        return {};
    }

    std::string_view normal() {
        normal_ = glm::dvec3(0);
        const std::string_view unused = numbers(normal_);
        if (!unused.empty() || !isFinite(normal_)) normal_ = glm::dvec3(0);
        return unused;
    }

    std::string_view vertex() {
        if (cornerCount_ == 3)
            throw Error(text_.where(), "a vertex is outside a loop, or the loop has more than three vertices");
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = text_.wordOnAnyLine();
            if (word.empty()) throw Error(text_.where(), "the file ends too early: no endsolid");
            corners_[cornerCount_][axis] = text_.numberOf(word);
        }
        if (!isFinite(corners_[cornerCount_])) throw Error(text_.where(), "a coordinate is not finite");
        if (++cornerCount_ < 3) return {};
        facets_.add(corners_, normal_);
        normal_ = glm::dvec3(0);
        return {};
    }

    TextStream text_;
    StlFacets facets_;
    std::array<glm::dvec3, 3> corners_{};
    std::size_t cornerCount_ = 3; ///< number of corners that the current triangle has so far; 3 between two triangles
    glm::dvec3 normal_{0};        ///< normal of the current triangle
    std::uint64_t colors_ = 0;
    bool isInSolid_ = false;
};

} // namespace

MemoryMesh readStlText(const InputFile& file) {
    return StlText(file).read();
}

} // namespace gnomon::read
