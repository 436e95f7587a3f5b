#include "preprocess/pipeline/work_directory.h"

#include "core/error.h"
#include "hierarchy/bytes.h"
#include "hierarchy/file_layout.h"
#include "preprocess/scratch/damage_error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>

#include <sys/stat.h>
#include <unistd.h>

namespace gnomon::pipeline {

namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

/// Returns the path of the work folder of a build. It depends only on the options, so that a resumed build finds the
/// folder.
std::string folderFor(const WorkDirectoryOptions& options) {
    if (options.folder.empty()) return options.output + ".building";
    const fs::path output = fs::absolute(options.output).lexically_normal();
    const std::uint64_t place = hierarchy::checksum64(bytesOf(output.string()));
    return (fs::path(options.folder) / (output.filename().string() + "." + std::to_string(place) + ".building"))
        .string();
}

constexpr const char* kScratchStem = "scratch.";

bool isAlive(const std::string& process) {
    return ::kill(static_cast<pid_t>(std::strtol(process.c_str(), nullptr, 10)), 0) == 0 || errno == EPERM;
}

/// Removes the unfinished output files of killed processes. AtomicFile defines the format of their names.
void removeLeftovers(const std::string& output) {
    const fs::path path = fs::absolute(output);
    const std::string start = path.filename().string() + ".";
    const std::string end = ".partial";
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) continue;
        const std::string middle = name.substr(start.size(), name.size() - start.size() - end.size());
        const std::string process = middle.substr(0, middle.find('.'));
        const std::string random = middle.substr(std::min(process.size() + 1, middle.size()));
        if (process.find_first_not_of("0123456789") != std::string::npos) continue;
        if (random.find_first_not_of("0123456789abcdef") != std::string::npos) continue;
        if (!isAlive(process)) fs::remove(entry.path(), ignored);
    }
}

/// Splits a build key into its entries, each with a name and a value. The value of an entry is its last word, and the
/// name is all words before it.
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

/// Returns the differences between two build keys as text. The text contains "name: expected value, found value" for
/// each differing entry.
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

std::unique_ptr<TemporaryName> heldName(const std::string& path) {
    return std::make_unique<TemporaryName>(path, [] { return true; });
}

} // namespace

WorkDirectory::Names::~Names() {
    if (held_.empty()) return;
    const std::string folder = held_.front()->path();
    std::vector<std::string> ours = {folder + "/checkpoints"};
    for (auto name = held_.begin() + 1; name != held_.end(); ++name)
        ours.push_back((*name)->path());
    ours.push_back(folder);
    log_.reset();
    while (!held_.empty())
        held_.pop_back();
    std::error_code failure;
    if (!fs::exists(folder, failure)) return;
    // The loop tries several times, because a file system may refuse to remove a file at first and permit it later.
    std::string reason;
    for (const std::string& path : ours)
        if (!fs::remove(path, failure) && failure && failure != std::errc::directory_not_empty && reason.empty())
            reason = "cannot remove " + path + ": " + failure.message();
    if (reason.empty()) reason = "there is something in it that no build has written";
    if (onKept_ && fs::exists(folder, failure)) onKept_(folder + ": it stays, " + reason);
}

void WorkDirectory::Names::make(const std::string& folder) {
    std::error_code ignored; // a missing folder causes the Error below
    if (const fs::path above = fs::path(folder).parent_path(); !above.empty()) fs::create_directories(above, ignored);
    constexpr unsigned kOwnersOnly = 0700;
    int error = 0;
    auto name = std::make_unique<TemporaryName>(folder, [&] {
        error = ::mkdir(folder.c_str(), kOwnersOnly) == 0 ? 0 : errno;
        return error == 0;
    });
    if (error == 0) {
        held_.push_back(std::move(name));
        takeOver(folder);
        return;
    }
    if (error != EEXIST)
        throw Error(folder, std::string("cannot create the folder for temporary files: ") + std::strerror(error));

    struct stat info {};

    // The folder must belong to this user, because another owner could replace the files of a build by links.
    if (::lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode) || info.st_uid != ::geteuid())
        throw Error(
            folder,
            "cannot use this folder for temporary files",
            "a folder of this user",
            S_ISDIR(info.st_mode) ? "another user's" : "a file or a link");
}

void WorkDirectory::Names::takeOver(const std::string& folder) {
    if (held_.size() > 1) return;
    if (held_.empty()) held_.push_back(heldName(folder));
    take(folder + "/lock");
}

void WorkDirectory::Names::take(const std::string& path) {
    held_.push_back(heldName(path));
    auto log = heldName(held_.front()->path() + "/checkpoints");
    if (log_) log_->keep([] { return true; });
    log_ = std::move(log);
}

void WorkDirectory::Names::leave() {
    if (log_) log_->keep([] { return true; });
    for (const auto& name : held_)
        name->keep([] { return true; });
    log_.reset();
    held_.clear();
}

WorkDirectory::WorkDirectory(const WorkDirectoryOptions& options, Progress& progress)
    : space_(progress), names_(options.onKept) {
    space_.limitRate(options.bytesPerSecond);
    if (options.isInMemory) {
        scratch_ = scratch::scratchInMemory(space_);
        return;
    }
    folder_ = folderFor(options);
    names_.make(folder_);
    lock_.emplace(folder_ + "/lock", File::Mode::Lock);
    if (!lock_->tryLock()) {
        names_.leave();
        throw Error(folder_, "another build uses this folder; wait for its end");
    }
    removeLeftovers(options.output);
    std::optional<scratch::RecordLog> records;
    if (options.isResumed) records = resumed(options.key);
    names_.takeOver(folder_);
    if (!records) {
        records = scratch::RecordLog::create(folder_ + "/checkpoints");
        records->append(bytesOf(options.key));
    }
    makeScratch();
    writer_.emplace(std::move(*records), *scratch_);
}

void WorkDirectory::makeScratch() {
    std::map<std::uint32_t, std::uint64_t> known;
    try {
        known = log_.scratchBytes();
    } catch (const hierarchy::Damage& damage) {
        throw scratch::DamageError(folder_ + "/checkpoints", damage.what);
    }
    place_ = {folder_ + "/" + kScratchStem, known.empty() ? 0 : known.rbegin()->first + 1};
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(kScratchStem)) continue;
        const std::string number = name.substr(std::strlen(kScratchStem));
        if (number.empty() || number.size() > 5 || number.find_first_not_of("0123456789") != std::string::npos)
            continue;
        if (!known.contains(static_cast<std::uint32_t>(std::stoul(number)))) fs::remove(entry.path(), ignored);
    }
    for (const auto& [part, bytes] : known)
        names_.take(scratch::partPath(place_.stem, part));
    expectProcesses(1);
    auto scratch = std::make_unique<scratch::PartedScratch>(place_.stem, place_.firstPart, space_);
    for (const auto& [part, bytes] : known)
        scratch->resume(part, bytes);
    scratch_ = std::move(scratch);
}

void WorkDirectory::expectProcesses(std::uint32_t count) {
    if (place_.firstPart + count >= scratch::kMaxParts)
        throw Error(
            folder_,
            "too many processes used this folder",
            "fewer than " + std::to_string(scratch::kMaxParts),
            std::to_string(place_.firstPart + count));
    for (; expected_ < count; ++expected_)
        names_.take(scratch::partPath(place_.stem, place_.firstPart + expected_));
}

void WorkDirectory::leave() {
    if (writer_) writer_->finish();
    names_.leave();
}

void WorkDirectory::release(const scratch::Blocks& blocks) {
    for (const scratch::Block& block : blocks)
        scratch_->release(block);
}

std::optional<scratch::RecordLog> WorkDirectory::resumed(const std::string& key) {
    std::optional<scratch::RecordLog> found = scratch::RecordLog::reopen(folder_ + "/checkpoints");
    if (!found || found->records().empty()) return {};
    const std::vector<std::byte>& first = found->records().front();
    const std::string before(reinterpret_cast<const char*>(first.data()), first.size());
    if (before != key)
        throw Error(folder_, "cannot resume, because the input or the options changed: " + differenceOf(key, before));
    try {
        for (std::size_t i = 1; i < found->records().size(); ++i)
            log_.addEncoded(found->records()[i]);
        log_.requireConsistent();
    } catch (const hierarchy::Damage& damage) {
        throw scratch::DamageError(folder_ + "/checkpoints", damage.what);
    }
    return found;
}

} // namespace gnomon::pipeline
