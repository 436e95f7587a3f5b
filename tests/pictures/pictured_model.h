// A model built from a mesh file, and pictures of it by an executor of one's choice: for tests that compare pictures.
#pragma once

#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "path/camera_path.h"

#include <memory>
#include <string>

namespace gnomon::tests {

/// A file in the folder of tests, named after the running test; gone with the object.
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

/// What `gnomon make KIND --triangles N --seed 1` writes.
void writeMade(const std::string& kind, std::uint64_t triangles, const std::string& path);

/// What `gnomon build` makes of `mesh` with its defaults.
void build(const std::string& mesh, const std::string& model);

enum class Backend { Software, Osmesa };

/// A picture, and how deep each pixel is; infinity where nothing is.
struct Drawn {
    executor::Picture picture;
    executor::FloatPicture depth;
};

/// An open model and who draws it.
class PicturedModel {
public:
    PicturedModel(const std::string& path, Backend backend);

    const hierarchy::ModelFile& file() const { return file_; }

    /// A frame that knows of none before it, with the default quality but for the geometric error.
    Drawn draw(const plan::View& view, double errorPixels);

private:
    hierarchy::ModelFile file_;
    std::unique_ptr<executor::Executor> executor_;
    frame::Renderer renderer_;
};

/// Three views of a model: the whole of it, on the way past it, and close to it.
std::vector<plan::View> threeViews(const hierarchy::ModelFile& model, int side);

} // namespace gnomon::tests
