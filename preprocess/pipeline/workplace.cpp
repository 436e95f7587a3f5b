#include "preprocess/pipeline/workplace.h"

#include "core/error.h"
#include "hierarchy/bytes.h"
#include "hierarchy/file_layout.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <map>

namespace gnomon::pipeline {

namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

/// The same for the same output, so that a resumed build finds it.
std::string folderFor(const WorkplaceOptions& options) {
    if (options.folder.empty()) return options.output + ".building";
    const fs::path output = fs::absolute(options.output).lexically_normal();
    const std::uint64_t place = hierarchy::checksum64(bytesOf(output.string()));
    return (fs::path(options.folder) / (output.filename().string() + "." + std::to_string(place) + ".building"))
        .string();
}

bool isAlive(const std::string& process) {
    return ::kill(static_cast<pid_t>(std::strtol(process.c_str(), nullptr, 10)), 0) == 0 || errno == EPERM;
}

/// Half-written outputs of processes that were killed: named as AtomicFile names them.
void removeLeftovers(const std::string& output) {
    const fs::path path = fs::absolute(output);
    const std::string start = path.filename().string() + ".";
    const std::string end = ".partial";
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) continue;
        const std::string process = name.substr(start.size(), name.size() - start.size() - end.size());
        if (process.find_first_not_of("0123456789") != std::string::npos) continue;
        if (!isAlive(process)) fs::remove(entry.path(), ignored);
    }
}

/// The entries of a key: name (all but the last word) and value.
std::vector<std::array<std::string, 2>> entriesOf(const std::string& key) {
    std::vector<std::array<std::string, 2>> entries;
    for (std::size_t begin = 0; begin < key.size();) {
        const std::size_t end = std::min(key.find(", ", begin), key.size());
        const std::string entry = key.substr(begin, end - begin);
        const std::size_t space = std::min(entry.rfind(' '), entry.size());
        entries.push_back({entry.substr(0, space), entry.substr(std::min(space + 1, entry.size()))});
        begin = end + 2;
    }
    return entries;
}

/// What differs between two keys: "name: expected value, found value" for each entry.
std::string differenceOf(const std::string& expected, const std::string& found) {
    std::map<std::string, std::array<std::string, 2>> values;
    const std::array keys{&expected, &found};
    for (std::size_t i = 0; i < keys.size(); ++i)
        for (const auto& [name, value] : entriesOf(*keys[i]))
            values[name][i] = value;
    std::string text;
    for (const auto& [name, both] : values) {
        if (both[0] == both[1]) continue;
        const auto told = [](const std::string& value) { return value.empty() ? "nothing" : value; };
        text += (text.empty() ? "" : "; ") + name + ": expected " + told(both[0]) + ", found " + told(both[1]);
    }
    return text;
}

} // namespace

Workplace::Workplace(const WorkplaceOptions& options, Progress& progress) : space_(progress) {
    if (options.isInMemory) return;
    const std::string folder = folderFor(options);
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) throw Error(folder, "cannot create the folder for temporary files: " + failed.message());
    lock_.emplace(folder + "/lock", File::Mode::Create);
    if (!lock_->tryLock()) throw Error(folder, "another build is at work there");
    removeLeftovers(options.output);
    std::optional<scratch::Journal> found;
    if (options.isResumed) found = scratch::Journal::reopen(folder + "/journal");
    if (found && !found->records().empty()) {
        const std::vector<std::byte>& first = found->records().front();
        const std::string key(reinterpret_cast<const char*>(first.data()), first.size());
        if (key != options.key)
            throw Error(folder, "cannot resume, input or options changed: " + differenceOf(options.key, key));
        journal_ = std::move(found);
        try {
            for (std::size_t i = 1; i < journal_->records().size(); ++i)
                ledger_.addEncoded(journal_->records()[i]);
        } catch (const hierarchy::Damage& damage) {
            throw Error(folder + "/journal", damage.what);
        }
        folder_ = folder;
        return;
    }
    folder_ = folder;
    for (const char* name : {"bins", "borders", "pages", "remains"})
        remove(name);
    journal_ = scratch::Journal::create(folder + "/journal");
    journal_->append(bytesOf(options.key));
}

Workplace::~Workplace() {
    if (folder_.empty()) return;
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::unique_ptr<scratch::ScratchFile> Workplace::scratch(const std::string& name, std::optional<std::uint64_t> keep) {
    if (folder_.empty()) return scratch::scratchInMemory(space_);
    const std::string path = folder_ + "/" + name;
    return keep ? scratch::reopenedScratch(path, *keep, space_) : scratch::scratchOnDisk(path, space_);
}

void Workplace::remove(const std::string& name) {
    if (folder_.empty()) return;
    std::error_code ignored;
    fs::remove(folder_ + "/" + name, ignored);
}

} // namespace gnomon::pipeline
