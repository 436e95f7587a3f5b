// Stores the recent views of models on disk for the next window.
#pragma once

#include "core/camera.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// A folder with one file per model. Its files are not trusted: the class reads at most kMaxBytes of a file, and an
/// invalid file is an Error.
class KeptViews {
public:
    /// Returns the folder $XDG_STATE_HOME/gnomon/views or ~/.local/state/gnomon/views. If neither is known, nothing is
    /// stored.
    static KeptViews ofUser();

    /// Uses `folder`. With an empty folder nothing is stored.
    explicit KeptViews(std::string folder) : folder_(std::move(folder)) {}

    /// Returns the stored cameras of `model` (a file or an address), oldest first, or an empty list. Throws Error if
    /// the file is invalid.
    std::vector<Camera> load(const std::string& model) const;

    /// Stores `cameras` of `model` atomically, unless they are equal to the last saved ones. If there are more than
    /// kMaxModels files, it removes the oldest. Throws Error if the folder cannot be written.
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
