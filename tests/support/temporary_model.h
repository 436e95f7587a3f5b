// A tiny model in its own file, for tests of subcommands.
#pragma once

#include "tests/support/tiny_model.h"

#include <filesystem>
#include <string>

#include <unistd.h>

namespace gnomon::tests {

/// A model file that the destructor removes.
class TemporaryModel {
public:
    explicit TemporaryModel(const TinyModelOptions& options, const std::string& name = "model")
        : path_((std::filesystem::temp_directory_path() /
                 ("gnomon_app_test_" + std::to_string(::getpid()) + "_" + name + ".gnm"))
                    .string()) {
        writeModel(makeTinyModel(options), path_);
    }

    ~TemporaryModel() { std::filesystem::remove(path_); }

    TemporaryModel(const TemporaryModel&) = delete;
    TemporaryModel& operator=(const TemporaryModel&) = delete;
    TemporaryModel(TemporaryModel&&) = delete;
    TemporaryModel& operator=(TemporaryModel&&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

} // namespace gnomon::tests
