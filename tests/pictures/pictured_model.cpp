#include "tests/pictures/pictured_model.h"

#include "gl/shader_library.h"
#include "path/suited_path.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/read/open_mesh_sources.h"
#include "render/gl/gl_backend.h"
#include "render/software_backend.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon::tests {

namespace {

std::unique_ptr<render::Backend> backendOf(Backend backend) {
    if (backend == Backend::Software) return render::makeSoftwareBackend();
    return render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), gibibytes(1));
}

} // namespace

ScratchFile::ScratchFile(const std::string& name) {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string place = std::string(test->test_suite_name()) + "_" + test->name() + "_" + name;
    for (char& c : place)
        if (c == '/') c = '_';
    path_ = testing::TempDir() + "gnomon_" + place;
}

ScratchFile::~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

void writeMade(const std::string& kind, std::uint64_t triangles, const std::string& path) {
    NoProgress progress;
    make::writeMadeModel(*make::makeNamedModel(kind, triangles, 1), path, "made for a test", 0, progress);
}

void build(const std::string& mesh, const std::string& model) {
    NoProgress progress;
    pipeline::BuildOptions options;
    options.output = model;
    pipeline::buildModel(*read::openMeshSources({mesh}, options.memory), options, progress);
}

PicturedModel::PicturedModel(const std::string& path, Backend backend)
    : file_(path), backend_(backendOf(backend)), renderer_(file_, *backend_, {gibibytes(2), {}}) {}

Drawn PicturedModel::draw(const plan::View& view, double errorPixels) {
    plan::Quality quality;
    quality.errorPixels = errorPixels;
    renderer_.render(view, quality, {});
    return {backend_->picture(), backend_->viewDepth()};
}

std::vector<plan::View> threeViews(const hierarchy::ModelFile& model, int side) {
    std::vector<plan::View> views;
    for (const auto& [kind, fraction] : {std::pair{"orbit", 0.1}, {"flyby", 0.4}, {"approach", 0.9}}) {
        const path::CameraPath path = path::suitedPath(model, kind);
        plan::View view;
        view.camera = path::cameraAt(path, path.keyframes.front().time + fraction * path.duration());
        view.width = view.height = side;
        views.push_back(view);
    }
    return views;
}

} // namespace gnomon::tests
