// The recent views of models on disk, for the next window that opens them.
#pragma once

#include "core/camera.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// A folder with one file a model. What is there may be anything: it is read up to kMostBytes, and what is no such file
/// is an Error, never a view.
class KeptViews {
public:
    /// $XDG_STATE_HOME/gnomon/views, or ~/.local/state/gnomon/views; where neither is known, nothing is kept.
    static KeptViews ofUser();

    /// An empty folder keeps nothing.
    explicit KeptViews(std::string folder) : folder_(std::move(folder)) {}

    /// The cameras that were kept of `model`, a file or an address, oldest first; none if there are none. Throws Error
    /// where the file holds something else.
    std::vector<Camera> load(const std::string& model) const;

    /// Keeps `cameras` of `model` in place of what was kept, all at once or not at all, unless they are the same as
    /// when this was last asked. Of more than kMostModels files the oldest go. Throws Error where the folder cannot be
    /// written.
    void save(const std::string& model, const std::vector<Camera>& cameras);

    static constexpr std::size_t kMostModels = 200;
    static constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 10U;

private:
    std::string fileOf(const std::string& model) const;
    void dropOldest() const;

    std::string folder_;
    std::map<std::string, std::string> saved_; // texts, by model
};

} // namespace gnomon::viewer
