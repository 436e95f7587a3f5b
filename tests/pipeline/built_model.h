// A model that a test builds from a mesh made in code and reads back completely.
#pragma once

#include "hierarchy/model_file.h"
#include "preprocess/pipeline/build_model.h"
#include "tests/support/code_mesh.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace gnomon::pipeline {

/// A model built from `mesh`. The destructor removes its file.
class BuiltModel {
public:
    explicit BuiltModel(read::CodeMesh mesh, BuildOptions options = {});
    ~BuiltModel();
    BuiltModel(const BuiltModel&) = delete;
    BuiltModel& operator=(const BuiltModel&) = delete;
    BuiltModel(BuiltModel&&) = delete;
    BuiltModel& operator=(BuiltModel&&) = delete;

    const BuildReport& report() const { return report_; }

    const hierarchy::ModelSummary& summary() const { return file_->summary(); }

    const std::vector<hierarchy::Page>& pages() const { return pages_; }

private:
    std::filesystem::path path_;
    BuildReport report_;
    std::unique_ptr<hierarchy::ModelFile> file_;
    std::vector<hierarchy::Page> pages_;
};

} // namespace gnomon::pipeline
