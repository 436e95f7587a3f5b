// An open model with its executor in the window: frames, pictures, and what became of its file.
#pragma once

#include "executor/executor.h"
#include "executor/overlay/window_picture.h"
#include "frame/accumulation.h"
#include "frame/drawn_point.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "hierarchy/model_file.h"
#include "settings/settings.h"
#include "settings/value_colors.h"
#include "storage/source.h"

#include <functional>
#include <memory>
#include <optional>

namespace gnomon::viewer {

/// Everything that a frame is drawn from.
struct Shot {
    plan::View view;
    plan::Quality quality;
    frame::FrameOptions options;
    settings::ValueColors colors;  // in place of the surfaces' own, of one frame; its options keep the surfaces then
    bool measuresAliasing = false; // once the frame is drawn; takes a second drawing
    int samples = 1;               // with `isAccumulated`: frames that the picture is to be the mean of

    /// Who sees the picture.
    const Camera& seenBy() const { return options.observerCamera ? *options.observerCamera : view.camera; }
};

/// A texture with the last frame's picture.
struct ShownPicture {
    GLuint texture = 0;
    bool isBottomUp = false; // its first row is the lowest
    bool isOpaque = false;   // its alpha is 1 all over
};

/// A model in a window's context, which must outlive it.
class Scene {
public:
    /// Opens `path`. The backend is the one that `settings` request, or the choice for the window's OpenGL; it can draw
    /// `colors`. Calls `onDamaged` once for each damaged page. Throws Error.
    Scene(
        const std::string& path,
        const settings::Settings& settings,
        const settings::ValueColors& colors,
        const gl::Context& context,
        std::function<void(const std::string&)> onDamaged);

    /// What is being read of a server is given up.
    ~Scene() { model_.source().stop(); }

    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    Scene(Scene&&) = delete;
    Scene& operator=(Scene&&) = delete;

    const hierarchy::ModelFile& model() const { return model_; }

    /// Draws; the result stays until the next call. Throws Error; then the last picture stays.
    const frame::Frame& draw(const Shot& shot);

    /// Frames to come depend on no frame before.
    void forget() { renderer_.forget(); }

    /// Nothing before the first frame.
    const frame::Frame* frame() const { return frame_ ? &*frame_ : nullptr; }

    /// Draws the last frame again, sampled elsewhere in its pixels: `shown` is the mean. It has to be one with
    /// `isAccumulated`. Throws Error; then the picture stays as it was.
    void addSample();

    /// Frames that the picture is the mean of; 0 where the last one was drawn without `isAccumulated`.
    int samples() const { return accumulation_.samples(); }

    /// Frames that it is to be the mean of: those asked for, or as many as its light takes.
    int wantedSamples() const { return accumulation_.wanted(); }

    /// The last frame's, or the mean, as `gnomon render` would write it.
    executor::Picture picture() const;

    /// The same as a texture, to be shown with `size` pixels, its hollows darkened if that is wanted.
    ShownPicture shown(const glm::ivec2& size, bool darkensHollows);

    /// Whether the last frame had anything to draw.
    bool isAnythingInView() const { return !frame_ || !frame_->facts.visible || frame_->facts.visible->anything; }

    /// The world point under a pixel of the last frame.
    std::optional<glm::dvec3> pick(const glm::ivec2& pixel);

    /// The same on the triangle that is drawn there.
    std::optional<frame::DrawnPoint> drawnPoint(const glm::ivec2& pixel);

    /// What became of the model's file since it was opened.
    storage::Fate fate() const { return model_.source().fate(); }

    /// Whether the last frame lacks pages that a server may yet send.
    bool isAwaiting() const;

    /// Returns the capabilities of the backend that draws.
    plan::Capabilities capabilities() const { return executor_->capabilities(); }

private:
    hierarchy::ModelFile model_;
    const gl::Context* context_;
    std::unique_ptr<executor::Executor> executor_;
    frame::Renderer renderer_;
    std::optional<frame::Frame> frame_;
    frame::Accumulation accumulation_;
    Camera seenBy_;
    std::optional<executor::Picture> colored_; // the last frame's, if it is coloured by a value
    executor::WindowPicture words_;            // of it, as is:
    gl::Texture uploaded_;                     // the picture of a backend without textures, or the mean
    bool isUploaded_ = false;
};

} // namespace gnomon::viewer
