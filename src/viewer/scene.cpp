#include "viewer/scene.h"

#include "hierarchy/source/open_source.h"
#include "inspect/value_picture.h"
#include "render/gl/gl_backend.h"
#include "render/light/eye_dome.h"
#include "render/software_backend.h"
#include "settings/backend_choice.h"
#include "validation/frame_validation.h"
#include "viewer/input/picking.h"

#include <chrono>
#include <utility>

namespace gnomon::viewer {

namespace {

constexpr int kPickReach = 6; // pixels around the cursor

/// Opens a model file or web address for reading. Requests to a server time out after one second, so that the user sees
/// the problem. The page store tries again.
std::unique_ptr<hierarchy::Source> sourceOf(const std::string& path) {
    hierarchy::Access access = hierarchy::commonAccess();
    access.retryTime = std::chrono::seconds(1);
    return hierarchy::openSource(path, access);
}

std::unique_ptr<render::Backend> windowBackend(
    const settings::Settings& settings, const settings::ValueColors& colors, const gl::Context& context) {
    const settings::BackendChoice choice = settings::chooseBackend(
        {.requested = settings.backend,
         .command = settings::DrawingCommand::View,
         .hasGpu = context.isHardware(),
         .need = settings::softwareNeed(settings, colors)});
    if (choice.backend == settings::Backend::Software) return render::makeSoftwareBackend();
    const gl::ShaderLibrary shaders(
        settings.shaderFolder.empty() ? std::nullopt : std::optional<std::string>(settings.shaderFolder));
    return render::makeWindowBackend(context, shaders, settings.gpuMemory);
}

} // namespace

Scene::Scene(
    const std::string& path,
    const settings::Settings& settings,
    const settings::ValueColors& colors,
    const gl::Context& context,
    std::function<void(const std::string&)> onDamaged)
    : model_(sourceOf(path), settings.memory),
      context_(&context),
      backend_(windowBackend(settings, colors, context)),
      renderer_(
          model_,
          *backend_,
          {.memory = settings.memory,
           .onDamaged =
               [onDamaged = std::move(onDamaged)](const lod::DamagedPage& page) {
                   onDamaged(
                       (page.isRetried  ? "pages could not be read, coarser pages are drawn until a new try succeeds: "
                        : page.isUnread ? "a page could not be read, coarser pages are drawn instead: "
                                        : "a page is damaged, coarser pages are drawn instead: ") +
                       page.reason);
               },
           .drawsWithoutUnread = true}) {}

const frame::Frame& Scene::draw(const Shot& shot) {
    plan::Quality quality = shot.quality;
    if (quality.shadows == plan::ShadowMode::Exact && !backend_->capabilities().exactShadows)
        quality.shadows = plan::ShadowMode::Rays; // the most accurate shadows of this backend
    if (shadow::rowsOf(quality.warp.rule) == shadow::RowSpacing::Logarithmic && !backend_->capabilities().unevenRows)
        quality.warp.rule = shadow::WarpRule::Auto; // the smallest aliasing bound of evenly spaced rows
    accumulation_.clear();
    frame_ = renderer_.render(shot.view, quality, shot.options, history_);
    history_ = frame_->history;
    colored_.reset();
    if (shot.colors.by != settings::ColorBy::None) { // before another frame replaces the data of this frame
        render::Picture colored = backend_->picture();
        inspect::colorByValues(shot.colors, renderer_, *frame_, colored);
        colored_ = std::move(colored);
    }
    if (shot.options.isAccumulated) accumulation_.begin(renderer_, *frame_, shot.samples);
    if (shot.measuresAliasing) {
        validation::ValidationOptions options;
        options.measuresAliasing = true;
        validation::setAccuracy(validation::validate(renderer_, *frame_, options), frame_->row);
    }
    seenBy_ = shot.seenBy();
    isUploaded_ = false;
    return *frame_;
}

void Scene::addSample() {
    isUploaded_ = false;
    try {
        accumulation_.add();
    } catch (...) {
        accumulation_.clear();
        throw;
    }
}

render::Picture Scene::picture() const {
    if (colored_) return *colored_;
    return samples() > 1 ? accumulation_.picture() : backend_->picture();
}

ShownPicture Scene::shown(const glm::ivec2& size, bool usesEyeDome) {
    if (!frame_) return {};
    if (const std::uint32_t texture = backend_->texture();
        texture != 0 && samples() <= 1 && !usesEyeDome && !colored_) {
        // The image texture is filtered linearly only on a GPU. With software OpenGL, this would take more time than
        // everything else in the window.
        const GLint filter = context_->isHardware() ? GL_LINEAR : GL_NEAREST;
        context_->api().textureParameteri(texture, GL_TEXTURE_MAG_FILTER, filter);
        return {texture, true, false};
    }
    if (!isUploaded_) {
        render::Picture picture = this->picture();
        if (usesEyeDome) {
            const double distance = seenBy_.isParallel() ? glm::length(seenBy_.target - seenBy_.eye) : 0;
            render::applyEyeDome(picture, backend_->viewDepth(), distance);
        }
        render::takePicture(picture, words_);
        if (uploaded_.width() != words_.width || uploaded_.height() != words_.height)
            uploaded_ = gl::Texture::ofWindowPictures(context_->api(), words_.width, words_.height);
        uploaded_.write(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, std::as_bytes(std::span(words_.pixels)));
        const bool isLess = picture.width < size.x || picture.height < size.y;
        uploaded_.setFilter(isLess ? GL_LINEAR : GL_NEAREST);
        isUploaded_ = true;
    }
    return {uploaded_.id(), false, true};
}

std::optional<glm::dvec3> Scene::pick(const glm::ivec2& pixel) {
    if (!frame_) return std::nullopt;
    return pointUnder(backend_->viewDepth(), seenBy_, pixel, kPickReach);
}

std::optional<frame::DrawnPoint> Scene::drawnPoint(const glm::ivec2& pixel) {
    if (!frame_) return std::nullopt;
    const std::optional<glm::ivec2> drawn = drawnPixel(backend_->viewDepth(), pixel, kPickReach);
    if (!drawn) return std::nullopt;
    frame::FrameOptions options = frame_->options;
    options.overlay = render::Overlay::None; // an overlay is not needed
    return frame::drawnPoint(renderer_, *frame_, options, *drawn);
}

bool Scene::isAwaiting() const {
    return model_.source().isRemote() && frame_ && frame_->row.pagesMissing.value_or(0) > 0;
}

} // namespace gnomon::viewer
