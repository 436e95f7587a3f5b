// Models made and built on the spot, for tests that want a real hierarchy of something that looks like the world.
#pragma once

#include "hierarchy/model_file.h"

#include <memory>
#include <string>

namespace gnomon::tests {

/// A built model in a folder of its own, which goes with it.
class BuiltFile {
public:
    /// What `gnomon make KIND --triangles N --seed 1` and `gnomon build` give.
    BuiltFile(const std::string& kind, std::uint64_t triangles);

    /// What `gnomon build` gives of a file.
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
