// The open model of the window and the backend that draws it: frames, images, and the state of the model's file.
#pragma once

#include "frame/accumulation.h"
#include "frame/drawn_point.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "hierarchy/model_file.h"
#include "hierarchy/source/source.h"
#include "render/backend.h"
#include "render/overlay/window_picture.h"
#include "settings/settings.h"
#include "settings/value_colors.h"

#include <functional>
#include <memory>
#include <optional>

namespace gnomon::viewer {

/// The input of a frame.
struct Shot {
    plan::View view;
    plan::Quality quality;
    frame::FrameOptions options;
    // The values that replace the surface colours of this frame. If they are set, `options` must request the visible
    // surfaces.
    settings::ValueColors colors;
    bool measuresAliasing = false; // measures the aliasing after the frame with a second drawing
    int samples = 1;               // with `isAccumulated`: number of frames in the mean

    /// Returns the camera from which the image is drawn.
    const Camera& seenBy() const { return options.observerCamera ? *options.observerCamera : view.camera; }
};

/// The image of the last frame as an OpenGL texture.
struct ShownPicture {
    GLuint texture = 0;
    bool isBottomUp = false; // its first row is the lowest one
    bool isOpaque = false;   // its alpha is 1 everywhere
};

/// An open model that is drawn in the OpenGL context of a window. The context must outlive it.
class Scene {
public:
    /// Opens the model at `path`. The backend is the one that `settings` request, else the one that suits the window's
    /// OpenGL. It can draw the values of `colors`. Calls `onDamaged` once for each damaged page. Throws Error.
    Scene(
        const std::string& path,
        const settings::Settings& settings,
        const settings::ValueColors& colors,
        const gl::Context& context,
        std::function<void(const std::string&)> onDamaged);

    /// Cancels the pending reads of the model's pages from a server.
    ~Scene() { model_.source().stop(); }

    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    Scene(Scene&&) = delete;
    Scene& operator=(Scene&&) = delete;

    const hierarchy::ModelFile& model() const { return model_; }

    /// Draws a frame of the model and returns its data, which are valid until the next call. If it throws Error, the
    /// last image stays.
    const frame::Frame& draw(const Shot& shot);

    /// Deletes the history of earlier frames, so that the next frame does not depend on them.
    void forget() { history_ = {}; }

    /// Returns the last frame, or null.
    const frame::Frame* frame() const { return frame_ ? &*frame_ : nullptr; }

    /// Draws the last frame again with another sample offset in its pixels. `shown` returns the
    /// mean of all samples. The frame must have `isAccumulated`. If it throws Error, the image does not change.
    void addSample();

    /// Returns how many frames the shown mean contains, or 0 if the last frame does not have `isAccumulated`.
    int samples() const { return accumulation_.samples(); }

    /// Returns how many frames the finished mean will contain: the requested number, or as many as the light directions
    /// need.
    int wantedSamples() const { return accumulation_.wanted(); }

    /// Returns the last image, or the mean of its samples, exactly as `gnomon render` would write it.
    render::Picture picture() const;

    /// Returns the image as a texture for a window of `size` pixels. If `usesEyeDome` is true, applies eye-dome
    /// lighting.
    ShownPicture shown(const glm::ivec2& size, bool usesEyeDome);

    /// Returns true if the last frame shows any geometry.
    bool isAnythingInView() const { return !frame_ || !frame_->facts.visible || frame_->facts.visible->anything; }

    /// Returns the world-space point that a pixel of the last frame shows.
    std::optional<glm::dvec3> pick(const glm::ivec2& pixel);

    /// Returns the point that a pixel of the last frame shows, with its triangle.
    std::optional<frame::DrawnPoint> drawnPoint(const glm::ivec2& pixel);

    /// Returns whether the file of the model is unchanged, changed or gone since it was opened.
    hierarchy::Fate fate() const { return model_.source().fate(); }

    /// Returns true if the last frame lacks pages of the model that a server may still send.
    bool isAwaiting() const;

    /// Returns which effects the backend of the scene can draw.
    plan::Capabilities capabilities() const { return backend_->capabilities(); }

private:
    hierarchy::ModelFile model_;
    const gl::Context* context_;
    std::unique_ptr<render::Backend> backend_;
    frame::Renderer renderer_;
    std::optional<frame::Frame> frame_;
    frame::History history_; // for the next frame
    frame::Accumulation accumulation_;
    Camera seenBy_;
    std::optional<render::Picture> colored_; // the last frame, if it is coloured by a value
    render::WindowPicture words_;            // the last image in the byte order of windows
    gl::Texture uploaded_;                   // texture with `words_`, if the backend has no texture of the image
    bool isUploaded_ = false;
};

} // namespace gnomon::viewer
