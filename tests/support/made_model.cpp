#include "tests/support/made_model.h"

#include "core/error.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/read/open_mesh_sources.h"

#include <cstdlib>
#include <filesystem>

namespace gnomon::tests {

namespace {

std::string newFolder() {
    std::string path = (std::filesystem::temp_directory_path() / "gnomon_built_XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr) throw Error(path, "cannot be made");
    return path;
}

} // namespace

BuiltFile::BuiltFile(const std::string& kind, std::uint64_t triangles) : folder_(newFolder()) {
    NoProgress progress;
    const std::string source = folder_ + "/" + kind + ".ply";
    make::writeMadeModel(*make::makeNamedModel(kind, triangles, 1), source, kind, 0, progress);
    build(source);
}

BuiltFile::BuiltFile(const std::string& source) : folder_(newFolder()) {
    build(source);
}

void BuiltFile::build(const std::string& source) {
    NoProgress progress;
    pipeline::BuildOptions options;
    options.output = folder_ + "/model.gnm";
    options.up = hierarchy::UpAxis();
    pipeline::buildModel(*read::openMeshSources({source}, options.memory), options, progress);
    file_ = std::make_unique<hierarchy::ModelFile>(options.output);
}

BuiltFile::~BuiltFile() {
    file_.reset();
    std::error_code ignored; // a folder left behind fails no test
    std::filesystem::remove_all(folder_, ignored);
}

} // namespace gnomon::tests
