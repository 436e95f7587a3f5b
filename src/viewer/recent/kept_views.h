// Stores the recent camera positions of each model on disk for later window sessions.
#pragma once

#include "core/camera.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// A folder with one file of recent cameras per model. The files are not trusted: the class reads at most kMaxBytes of
/// a file, and throws Error for an invalid file.
class KeptViews {
public:
    /// Uses the folder $XDG_STATE_HOME/gnomon/views, or ~/.local/state/gnomon/views. If neither variable is set,
    /// nothing is stored.
    static KeptViews ofUser();

    /// Uses `folder`. If its name is empty, nothing is stored.
    explicit KeptViews(std::string folder) : folder_(std::move(folder)) {}

    /// Returns the stored cameras of `model` (a file or a web address), oldest first. Returns an empty list if there
    /// are none. Throws Error if the file is invalid.
    std::vector<Camera> load(const std::string& model) const;

    /// Stores `cameras` of `model` atomically, unless they are equal to the last stored ones. If there are more than
    /// kMaxModels files, removes the oldest ones. Throws Error if the folder cannot be written.
    void save(const std::string& model, const std::vector<Camera>& cameras);

    static constexpr std::size_t kMaxModels = 200;
    static constexpr std::uint64_t kMaxBytes = std::uint64_t{256} << 10U;

private:
    std::string fileOf(const std::string& model) const;
    void dropOldest() const;

    std::string folder_;
    std::map<std::string, std::string> saved_; // saved texts, by model
};

} // namespace gnomon::viewer
