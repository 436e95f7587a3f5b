#include "preprocess/pipeline/source_up.h"

#include "core/file.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>

namespace gnomon::pipeline {

namespace {

using hierarchy::UpAxis;

constexpr std::size_t kMaxHeaderBytes = 64U << 10U; // number of bytes that are searched at the start of a file

bool isLetter(char c) {
    return c >= 'a' && c <= 'z';
}

bool isWordEnd(std::string_view text, std::size_t at) {
    return at >= text.size() || !isLetter(text[at]);
}

/// Returns the axis that the letter at index `at` of `text` names, with its sign. Returns nullopt if the letter is not
/// a separate word.
std::optional<UpAxis> axisAt(std::string_view text, std::size_t at) {
    if (at >= text.size() || text[at] < 'x' || text[at] > 'z') return std::nullopt;
    if (at + 1 < text.size() && isLetter(text[at + 1])) return std::nullopt;
    if (at > 0 && isLetter(text[at - 1])) return std::nullopt;
    const bool isDown = at > 0 && text[at - 1] == '-';
    return hierarchy::upAxisNamed(isDown ? text.substr(at - 1, 2) : text.substr(at, 1));
}

/// Returns the axis in a text like "z up", "z-up" or "z_up". `up` is the index of the word "up".
std::optional<UpAxis> axisBefore(std::string_view text, std::size_t up) {
    const bool isApart = up >= 2 && (text[up - 1] == ' ' || text[up - 1] == '-' || text[up - 1] == '_');
    return isApart ? axisAt(text, up - 2) : std::nullopt;
}

/// Returns the axis in a text like "up: z", "up axis = z" or "up_axis:-z". `up` is the index of the word "up".
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

/// Combines the earlier statement `said` about the up axis with the statement `more`. Sets `isOne` to false if the two
/// contradict each other.
void agree(std::optional<UpAxis>& said, const std::optional<UpAxis>& more, bool& isOne) {
    if (!more) return;
    if (said && !(*said == *more)) isOne = false;
    said = more;
}

/// The default up axis of a program that exports meshes.
struct Exporter {
    std::string_view name;   // name of the program in comments, in lower case
    std::string_view up;     // up axis in files of any format
    std::string_view ofObjs; // up axis in OBJ files
};

constexpr std::array kExporters = {
    Exporter{"blender", "z", "y"},        Exporter{"sketchup", "z", "y"},       Exporter{"3ds max", "z", "y"},
    Exporter{"rhino", "z", "y"},          Exporter{"maya", "y", "y"},           Exporter{"zbrush", "y", "y"},
    Exporter{"wings3d", "y", "y"},        Exporter{"cinema 4d", "y", "y"},      Exporter{"cloudcompare", "z", "z"},
    Exporter{"metashape", "z", "z"},      Exporter{"photoscan", "z", "z"},      Exporter{"pix4d", "z", "z"},
    Exporter{"contextcapture", "z", "z"}, Exporter{"realitycapture", "z", "z"}, Exporter{"ifcopenshell", "z", "z"},
    Exporter{"freecad", "z", "z"},        Exporter{"openscad", "z", "z"},       Exporter{"solidworks", "z", "z"},
    Exporter{"revit", "z", "z"},          Exporter{"autocad", "z", "z"},        Exporter{"qgis", "z", "z"},
};

// Votes for the up axis, relative to hierarchy::kSureVotes. The votes of a known exporting program are almost
// sufficient alone. The votes of a kind of file decide only if the votes from the shape are close.
constexpr int kExporterVotes = 2000;
constexpr int kKindVotes = 1000;

/// Returns the comments at the start of a file, one per line. They are the "comment" or "obj_info" lines of a PLY
/// header, the "#" lines of an OBJ or OFF file, or the header of an STL file.
std::string commentsOf(const std::string& path, const std::string& suffix) {
    constexpr std::size_t kStlHeader = 80;
    const File file(path, File::Mode::Read);
    std::string text(suffix == ".stl" ? kStlHeader : kMaxHeaderBytes, '\0');
    text.resize(file.readSomeAt(0, std::as_writable_bytes(std::span(text.data(), text.size()))));
    if (suffix == ".stl") return text.substr(0, text.find_first_of("\r\n"));
    const bool isPly = text.starts_with("ply");
    if (isPly) text.resize(std::min(text.find("end_header"), text.size()));
    std::string comments;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        if (isPly ? line.starts_with("comment ") || line.starts_with("obj_info ") : line.starts_with('#'))
            comments.append(line.substr(isPly ? line.find(' ') : 1)).append("\n");
        begin = end + 1;
    }
    return comments;
}

void addVotes(hierarchy::UpVotes& votes, std::string_view axis, int count) {
    constexpr std::size_t kY = 2;
    constexpr std::size_t kZ = 4;
    votes[axis == "y" ? kY : kZ] += count;
}

/// Returns votes for the usual up axis of files with the suffix `suffix` and the comments `comments`.
hierarchy::UpVotes votesOf(const std::string& suffix, const std::string& comments) {
    hierarchy::UpVotes votes{};
    const std::string text = lowered(comments);
    const bool isObj = suffix == ".obj";
    const auto* const exporter = std::ranges::find_if(
        kExporters, [&](const Exporter& each) { return text.find(each.name) != std::string::npos; });
    if (exporter != kExporters.end())
        addVotes(votes, isObj ? exporter->ofObjs : exporter->up, kExporterVotes);
    else if (isObj)
        addVotes(votes, "y", kKindVotes);
    else if (suffix == ".stl")
        addVotes(votes, "z", kKindVotes);
    return votes;
}

} // namespace

std::optional<UpAxis> upOfComment(std::string_view comment) {
    const std::string text = lowered(comment);
    std::optional<UpAxis> said;
    bool isOne = true;
    for (std::size_t up = text.find("up"); up != std::string::npos; up = text.find("up", up + 1)) {
        const bool isJoined = up > 0 && (up == 1 || !isLetter(text[up - 2])) && isWordEnd(text, up + 2);
        if (isJoined && (text[up - 1] == 'y' || text[up - 1] == 'z'))
            agree(said, hierarchy::upAxisNamed(text.substr(up - 1, 1)), isOne);
        const bool isWord = (up == 0 || !isLetter(text[up - 1])) && isWordEnd(text, up + 2);
        if (!isWord) continue;
        agree(said, axisBefore(text, up), isOne);
        agree(said, axisBehind(text, up), isOne);
    }
    return isOne ? said : std::nullopt;
}

SourceUp upOfSources(const std::vector<std::string>& paths) {
    SourceUp found;
    bool isOne = true;
    for (const std::string& path : paths) {
        const std::string suffix = read::loweredSuffix(path);
        if (suffix == ".gltf" || suffix == ".glb") {
            agree(found.told, hierarchy::upAxisNamed("y"), isOne); // the glTF format defines the axis
            continue;
        }
        agree(found.told, upOfComment(std::filesystem::path(path).stem().string()), isOne);
        const std::string comments = commentsOf(path, suffix);
        for (std::size_t begin = 0; begin < comments.size();) {
            const std::size_t end = std::min(comments.find('\n', begin), comments.size());
            agree(found.told, upOfComment(std::string_view(comments).substr(begin, end - begin)), isOne);
            begin = end + 1;
        }
        const hierarchy::UpVotes votes = votesOf(suffix, comments);
        for (std::size_t i = 0; i < votes.size(); ++i)
            found.votes[i] += votes[i] / static_cast<int>(paths.size());
    }
    if (!isOne) found.told = std::nullopt;
    return found;
}

void askForUpOfSources(BuildOptions& options, const std::vector<std::string>& paths) {
    const SourceUp found = upOfSources(paths);
    options.up = found.told;
    options.upBecause = "as its source says";
    options.upVotes = found.votes;
}

} // namespace gnomon::pipeline
