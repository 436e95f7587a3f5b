// A model built from a mesh file, and pictures of it by a chosen backend, for tests that compare pictures.
#pragma once

#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "path/camera_path.h"

#include <memory>
#include <string>

namespace gnomon::tests {

/// A file in the folder of tests, named after the running test. The destructor removes it.
class ScratchFile {
public:
    explicit ScratchFile(const std::string& name);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&&) = delete;
    ScratchFile& operator=(ScratchFile&&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// Writes the mesh of `gnomon make KIND --triangles N --seed 1`.
void writeMade(const std::string& kind, std::uint64_t triangles, const std::string& path);

/// Builds `mesh` to `model` with the defaults of `gnomon build`.
void build(const std::string& mesh, const std::string& model);

enum class Backend { Software, Osmesa };

/// A picture and the depth of each pixel, which is infinite without a surface.
struct Drawn {
    render::Picture picture;
    render::FloatPicture depth;
};

/// An open model with a backend.
class PicturedModel {
public:
    PicturedModel(const std::string& path, Backend backend);

    const hierarchy::ModelFile& file() const { return file_; }

    /// Draws a frame without history, with the default quality except for the geometric error.
    Drawn draw(const plan::View& view, double errorPixels);

private:
    hierarchy::ModelFile file_;
    std::unique_ptr<render::Backend> backend_;
    frame::Renderer renderer_;
};

/// Returns three views of a model: the whole model, a view past it, and a close view.
std::vector<plan::View> threeViews(const hierarchy::ModelFile& model, int side);

} // namespace gnomon::tests
