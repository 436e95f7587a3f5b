#include "tests/pipeline/built_model.h"

#include <string>

#include <unistd.h>

namespace gnomon::pipeline {

BuiltModel::BuiltModel(read::CodeMesh mesh, BuildOptions options) {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("gnomon_build_" + std::to_string(::getpid()) + "_" + std::to_string(number++) + ".gnm");
    options.output = path_.string();
    NoProgress progress;
    report_ = buildModel(mesh, options, progress);
    file_ = std::make_unique<hierarchy::ModelFile>(path_.string());
    for (std::uint32_t page = 0; page < file_->pages().size(); ++page)
        pages_.push_back(file_->readPage(page));
}

BuiltModel::~BuiltModel() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

} // namespace gnomon::pipeline
