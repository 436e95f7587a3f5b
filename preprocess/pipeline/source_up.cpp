#include "preprocess/pipeline/source_up.h"

#include "core/file.h"
#include "preprocess/read/words.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

using hierarchy::UpAxis;

constexpr std::size_t kMostHeader = 64U << 10U; // bytes that are looked at

bool isLetter(char c) {
    return c >= 'a' && c <= 'z';
}

/// The axis named by the letter at `at`, and the sign before it, if nothing else is joined to them.
std::optional<UpAxis> axisAt(std::string_view text, std::size_t at) {
    if (at >= text.size() || text[at] < 'x' || text[at] > 'z') return std::nullopt;
    if (at + 1 < text.size() && isLetter(text[at + 1])) return std::nullopt;
    if (at > 0 && isLetter(text[at - 1])) return std::nullopt;
    const bool isDown = at > 0 && text[at - 1] == '-';
    return hierarchy::upAxisNamed(isDown ? text.substr(at - 1, 2) : text.substr(at, 1));
}

/// The axis of "z up" or "z-up" whose second word begins at `up`.
std::optional<UpAxis> axisBefore(std::string_view text, std::size_t up) {
    const bool isApart = up >= 2 && (text[up - 1] == ' ' || text[up - 1] == '-');
    return isApart ? axisAt(text, up - 2) : std::nullopt;
}

/// The axis of "up: z", "up axis = z" or "up_axis:-z" whose first word begins at `up`.
std::optional<UpAxis> axisBehind(std::string_view text, std::size_t up) {
    std::string_view rest = text.substr(up + 2);
    if (rest.size() > 5 && (rest[0] == ' ' || rest[0] == '_' || rest[0] == '-') && rest.substr(1, 4) == "axis")
        rest.remove_prefix(5);
    const std::size_t colon = rest.find_first_not_of(' ');
    if (colon == std::string_view::npos || (rest[colon] != ':' && rest[colon] != '=')) return std::nullopt;
    const std::size_t value = rest.find_first_not_of(" +-", colon + 1);
    return value == std::string_view::npos ? std::nullopt : axisAt(rest, value);
}

std::string lowered(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

/// What two sayings come to: `isOne` is false from where they contradict each other on.
void agree(std::optional<UpAxis>& said, const std::optional<UpAxis>& more, bool& isOne) {
    if (!more) return;
    if (said && !(*said == *more)) isOne = false;
    said = more;
}

std::string headerOf(const std::string& path) {
    const File file(path, File::Mode::Read);
    std::string text(kMostHeader, '\0');
    text.resize(file.readSomeAt(0, std::as_writable_bytes(std::span(text.data(), text.size()))));
    if (!text.starts_with("ply")) return {};
    return text.substr(0, text.find("end_header"));
}

} // namespace

std::optional<UpAxis> upOfComment(std::string_view comment) {
    const std::string text = lowered(comment);
    std::optional<UpAxis> said;
    bool isOne = true;
    for (std::size_t up = text.find("up"); up != std::string::npos; up = text.find("up", up + 1)) {
        const bool isWord = (up == 0 || !isLetter(text[up - 1])) && (up + 2 >= text.size() || !isLetter(text[up + 2]));
        if (!isWord) continue;
        agree(said, axisBefore(text, up), isOne);
        agree(said, axisBehind(text, up), isOne);
    }
    return isOne ? said : std::nullopt;
}

std::optional<UpAxis> upOfSources(const std::vector<std::string>& paths) {
    std::optional<UpAxis> said;
    bool isOne = true;
    for (const std::string& path : paths) {
        if (const std::string suffix = read::loweredSuffix(path); suffix == ".gltf" || suffix == ".glb") {
            agree(said, hierarchy::upAxisNamed("y"), isOne); // by the format
            continue;
        }
        const std::string header = headerOf(path);
        for (std::size_t begin = 0; begin < header.size();) {
            const std::size_t end = std::min(header.find_first_of("\r\n", begin), header.size());
            const std::string_view line = std::string_view(header).substr(begin, end - begin);
            if (line.starts_with("comment ") || line.starts_with("obj_info "))
                agree(said, upOfComment(line.substr(line.find(' '))), isOne);
            begin = end + 1;
        }
    }
    return isOne ? said : std::nullopt;
}

void askForUpOfSources(BuildOptions& options, const std::vector<std::string>& paths) {
    options.up = upOfSources(paths);
    options.upBecause = "as its source says";
}

} // namespace gnomon::pipeline
