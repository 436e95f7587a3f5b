#include "preprocess/read/obj/library_finder.h"

#include "preprocess/read/words.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace gnomon::read {

namespace {

constexpr std::size_t kLongestJoin = 16;  ///< max number of words in a file name
constexpr std::size_t kMaxJoinWords = 64; ///< lines with more words are lists of names without blanks

/// Limits of the search for material libraries: the length of a name, the number of searches in the file system, the
/// number of listed folders, and the number of names in a folder. No real OBJ file reaches these limits.
constexpr std::size_t kLongestName = 4096;
constexpr std::size_t kMaxSearches = 4096;
constexpr std::size_t kMaxListings = 64;
constexpr std::size_t kMaxNamesInFolder = 100'000;

bool isFile(const std::filesystem::path& path) {
    std::error_code missing;
    return std::filesystem::is_regular_file(path, missing);
}

/// Returns true if `word` can be the last word of a material library's file name.
bool endsName(std::string_view word) {
    if (word.ends_with('"')) word.remove_suffix(1);
    return loweredSuffix(word) == ".mtl";
}

std::string baseOf(std::string_view name) {
    return std::string(name.substr(name.find_last_of("/\\") + 1));
}

/// Returns the words [first, first + count) of a line, with the blanks between them. Returns an empty string if this
/// text is too long for a file name.
std::string joinOf(const std::vector<std::string_view>& words, std::size_t first, std::size_t count) {
    const std::string_view last = words[first + count - 1];
    const std::string_view join(
        words[first].data(), static_cast<std::size_t>(last.data() + last.size() - words[first].data()));
    return join.size() > kLongestName ? std::string() : std::string(join);
}

} // namespace

LibraryFinder::LibraryFinder(const std::string& path, const std::string& sourceRoot)
    : folder_(std::filesystem::path(path).parent_path().string()), root_(path, sourceRoot) {}

LibraryFinder::Found LibraryFinder::filesOf(std::string_view names, const std::string& where) {
    Found found;
    const std::vector<std::string_view> words = wordsOf(names);
    const std::size_t longest = words.size() > kMaxJoinWords ? 1 : kLongestJoin;
    for (std::size_t first = 0; first < words.size();) {
        std::string file;
        std::size_t count = std::min(words.size() - first, longest);
        for (; file.empty() && count > 0; --count)
            file = fileOf(joinOf(words, first, count), where);
        if (!file.empty()) {
            first += count + 1;
            found.files.push_back(std::move(file));
            continue;
        }
        if (words[first].starts_with('#')) break; // the rest of the line is a comment
        // The path of another computer can also contain blanks. Such a path ends at a word with the suffix of a
        // library.
        count = 1;
        while (count < longest && first + count < words.size() && !endsName(words[first + count - 1]))
            ++count;
        if (!endsName(words[first + count - 1])) count = 1;
        file = baseFileOf(std::string(unquoted(joinOf(words, first, count))), where);
        first += count;
        if (file.empty())
            ++found.missing;
        else
            found.files.push_back(std::move(file));
    }
    return found;
}

std::string LibraryFinder::fileOf(const std::string& name, const std::string& where) {
    if (name.empty() || name.find('\0') != std::string::npos) return {};
    const auto known = files_.find(name);
    if (known != files_.end()) return known->second;
    if (searches_ == kMaxSearches) return {};
    ++searches_;
    std::vector<std::string> spellings = {name};
    if (const std::string_view inner = unquoted(name); inner != name) spellings.emplace_back(inner);
    if (name.find('\\') != std::string::npos) {
        spellings.push_back(spellings.back());
        std::replace(spellings.back().begin(), spellings.back().end(), '\\', '/');
    }
    std::string file;
    for (const std::string& spelling : spellings)
        if (file.empty()) file = searchedFileOf(spelling, where);
    return files_[name] = file;
}

/// Returns the file `name`, or a file whose name differs only in upper and lower case. Returns an empty string if no
/// such file exists.
std::string LibraryFinder::searchedFileOf(const std::string& name, const std::string& where) {
    const std::filesystem::path given = std::filesystem::path(name).lexically_normal();
    if (isFile(folder_ / given)) return root_.pathOf(name, where);
    if (given.is_absolute()) return {};
    std::filesystem::path found;
    for (const std::filesystem::path& part : given) {
        std::error_code missing;
        if (std::filesystem::exists(folder_ / found / part, missing)) {
            found /= part;
            continue;
        }
        const auto& names = namesIn((folder_ / found).string());
        const auto alike = names.find(lowered(part.string()));
        if (alike == names.end()) return {};
        found /= alike->second;
    }
    return isFile(folder_ / found) ? root_.pathOf(found.string(), where) : std::string();
}

std::string LibraryFinder::baseFileOf(const std::string& name, const std::string& where) {
    const std::string base = baseOf(name);
    if (base.empty() || base == name) return {};
    std::string file = fileOf(base, where);
    if (!file.empty() && remark_.empty())
        remark_ = "there is no material library " + quotedForMessage(name) + "; " + quotedForMessage(baseOf(file)) +
                  " in the folder of the OBJ is read instead";
    return file;
}

const std::map<std::string, std::string>& LibraryFinder::namesIn(const std::string& folder) {
    static const std::map<std::string, std::string> kNone;
    const auto known = listings_.find(folder);
    if (known != listings_.end()) return known->second;
    if (listings_.size() >= kMaxListings) return kNone;
    std::map<std::string, std::string>& names = listings_[folder];
    std::error_code failed;
    std::filesystem::directory_iterator entries(folder.empty() ? "." : folder, failed);
    for (std::size_t count = 0;
         !failed && entries != std::filesystem::directory_iterator() && count < kMaxNamesInFolder;
         entries.increment(failed), ++count) {
        const std::string name = entries->path().filename().string();
        const auto [alike, isNew] = names.try_emplace(lowered(name), name);
        if (!isNew)
            alike->second = std::min(
                alike->second, name); // makes the result independent of the order in which the system lists files
    }
    return names;
}

} // namespace gnomon::read
