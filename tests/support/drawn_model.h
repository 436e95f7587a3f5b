// A model in a file of its own with a renderer over the software backend.
#pragma once

#include "frame/renderer.h"
#include "render/software_backend.h"
#include "tests/support/tiny_model.h"

#include <filesystem>
#include <memory>
#include <string>

#include <unistd.h>

namespace gnomon::frame {

/// A model made in code, and its renderer. Each frame is planned without history.
class DrawnModel {
public:
    explicit DrawnModel(const tests::TinyModel& model) {
        tests::writeModel(model, path_);
        file_ = std::make_unique<hierarchy::ModelFile>(path_);
        renderer_ = std::make_unique<Renderer>(*file_, *backend_, ResidencyOptions());
    }

    ~DrawnModel() { std::filesystem::remove(path_); }

    DrawnModel(const DrawnModel&) = delete;
    DrawnModel& operator=(const DrawnModel&) = delete;
    DrawnModel(DrawnModel&&) = delete;
    DrawnModel& operator=(DrawnModel&&) = delete;

    Frame draw(const plan::View& view, const plan::Quality& quality, const FrameOptions& options = {}) {
        return renderer_->render(view, quality, options);
    }

    Renderer& renderer() { return *renderer_; }

    render::Backend& backend() { return *backend_; }

    const hierarchy::ModelFile& file() const { return *file_; }

private:
    static inline int count_ = 0; // NOLINT: several may live at once, and each wants a name
    std::string path_ = (std::filesystem::temp_directory_path() /
                         ("gnomon_drawn_" + std::to_string(::getpid()) + "_" + std::to_string(count_++) + ".gnm"))
                            .string();
    std::unique_ptr<hierarchy::ModelFile> file_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    std::unique_ptr<Renderer> renderer_;
};

} // namespace gnomon::frame
