// Generated models, built during the test, for tests that need a real hierarchy of a realistic scene.
#pragma once

#include "hierarchy/model_file.h"

#include <memory>
#include <string>

namespace gnomon::tests {

/// A built model in a folder of its own. The destructor removes the folder.
class BuiltFile {
public:
    /// Makes the model of `gnomon make KIND --triangles N --seed 1`, followed by `gnomon build`.
    BuiltFile(const std::string& kind, std::uint64_t triangles);

    /// Builds the model of a mesh file.
    explicit BuiltFile(const std::string& source);

    ~BuiltFile();
    BuiltFile(const BuiltFile&) = delete;
    BuiltFile& operator=(const BuiltFile&) = delete;
    BuiltFile(BuiltFile&&) = delete;
    BuiltFile& operator=(BuiltFile&&) = delete;

    const hierarchy::ModelFile& file() const { return *file_; }

private:
    void build(const std::string& source);

    std::string folder_;
    std::unique_ptr<hierarchy::ModelFile> file_;
};

} // namespace gnomon::tests
