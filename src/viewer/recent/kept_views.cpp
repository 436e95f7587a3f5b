#include "viewer/recent/kept_views.h"

#include "core/error.h"
#include "core/file.h"
#include "core/formatted.h"
#include "hierarchy/file_layout.h"
#include "path/camera_path.h"
#include "viewer/environment_path.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <system_error>

namespace gnomon::viewer {

namespace {

namespace fs = std::filesystem;

/// Returns the text that identifies a model: the canonical path of its file, or its web address.
std::string nameOf(const std::string& model) {
    if (model.find("://") != std::string::npos) return model;
    std::error_code failure;
    const fs::path place = fs::weakly_canonical(fs::absolute(model, failure), failure);
    return failure ? model : place.string();
}

/// Returns true if `name` looks like a file name that `fileOf` creates. Files with other names are never removed.
bool isNameOfFile(const std::string& name) {
    return name.size() == 16 + 5 && name.ends_with(".json") &&
           name.find_first_not_of("0123456789abcdef") == name.find(".json");
}

} // namespace

KeptViews KeptViews::ofUser() {
    const std::string state = environmentPath("XDG_STATE_HOME");
    const std::string home = environmentPath("HOME");
    if (state.empty() && home.empty()) return KeptViews("");
    return KeptViews((state.empty() ? home + "/.local/state" : state) + "/gnomon/views");
}

std::string KeptViews::fileOf(const std::string& model) const {
    const std::string name = nameOf(model);
    const std::uint64_t hash = hierarchy::checksum64(std::as_bytes(std::span(name)));
    return folder_ + formatted("/%016llx.json", static_cast<unsigned long long>(hash));
}

std::vector<Camera> KeptViews::load(const std::string& model) const {
    if (folder_.empty()) return {};
    const std::string file = fileOf(model);
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    if (!fs::exists(status)) return {};
    if (!fs::is_regular_file(status)) throw Error(file, "cannot read recent views", "a file", "something else");
    const std::uintmax_t bytes = fs::file_size(file, failure);
    if (failure || bytes > kMaxBytes)
        throw Error(
            file, "the file of recent views is too long", formatted("at most %llu bytes", 0ULL + kMaxBytes), "more");
    const path::SavedViews views = path::readViews(file);
    return views.model == nameOf(model) ? views.cameras : std::vector<Camera>(); // another model with the same hash
}

void KeptViews::save(const std::string& model, const std::vector<Camera>& cameras) {
    if (folder_.empty() || cameras.empty()) return;
    std::string text = path::toJson(path::SavedViews{nameOf(model), cameras});
    std::string& last = saved_[model];
    if (last == text) return;
    std::error_code failure;
    fs::create_directories(folder_, failure);
    if (failure) throw Error(folder_, "cannot save recent views: " + failure.message());
    writeTextFile(fileOf(model), text);
    last = std::move(text);
    dropOldest();
}

void KeptViews::dropOldest() const {
    std::error_code failure;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, failure))
        if (isNameOfFile(entry.path().filename().string()) && fs::is_regular_file(entry.symlink_status(failure)))
            files.emplace_back(entry.last_write_time(failure), entry.path());
    if (files.size() <= kMaxModels) return;
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i + kMaxModels < files.size(); ++i)
        fs::remove(files[i].second, failure);
}

} // namespace gnomon::viewer
