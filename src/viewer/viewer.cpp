#include "viewer/viewer.h"

#include "core/error.h"
#include "core/printable.h"
#include "core/temporary_name.h"
#include "path/camera_path.h"
#include "settings/resolve.h"
#include "settings/sun_settings.h"
#include "telemetry/process_clock.h"
#include "viewer/window_session.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

namespace {

constexpr double kIdleSeconds = 0.25;
constexpr std::size_t kHistory = 240;
constexpr int kPadSide = 33;

double now() {
    return glfwGetTime();
}

int drawnSide(int pixels, double resolution) {
    return std::max(static_cast<int>(std::lround(pixels * resolution)), 1);
}

/// Returns the measured times and counts of a drawn frame, as input of the quality governor.
FrameLoad loadOf(const frame::Frame& frame, double milliseconds, double targetMs) {
    const telemetry::FrameRow& row = frame.row;
    FrameLoad load;
    load.milliseconds = milliseconds;
    load.imageMs = row.imageMs.value_or(0);
    load.shadowMs = row.shadowMs.value_or(0);
    load.triangles = static_cast<double>(row.imageTriangles.value_or(0));
    load.pixels = static_cast<double>(frame.plan.view.width) * frame.plan.view.height;
    load.resolvesPoints = frame.hasOneCasterList();
    load.errors = shadowErrors(frame.plan, frame.facts, milliseconds > targetMs);
    return load;
}

} // namespace

WindowSession::WindowSession(const ViewerOptions& options)
    : options_(options),
      window_([&] {
          const auto [width, height] = options.settings.imageSize;
          return gl::Window("Gnomon", width, height);
      }()),
      input_(window_.handle()),
      imgui_(window_.handle()),
      fill_(window_.context().api(), gl::ShaderLibrary()),
      messages_(now, options_.tell),
      file_(options_, window_.context(), messages_, now, [this](const Scene& scene) { enter(scene); }),
      walk_(
          messages_,
          now,
          options.path.empty()
              ? std::nullopt
              : std::optional(path::projected(path::readCameraPath(options.path), options.settings.projection)),
          options.frames),
      history_(kHistory),
      pad_(kPadSide) {
    settings_.asked = options_.settings;
    settings_.asked.quality = settings::qualityOf(options_.settings);
    settings_.targetMs = options_.targetMs;
    settings_.colors = options_.colors;
    caps_.memoryBytes = options_.settings.memory.count;
    caps_.gpuMemoryBytes = options_.settings.gpuMemory.count;
    if (!options_.csv.empty()) log_.emplace(options_.csv);
    open(options_.file);
    lastFrame_ = now();
}

glm::ivec2 WindowSession::framebufferSize() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_.handle(), &size.x, &size.y);
    return size;
}

void WindowSession::run(Progress& interrupt) {
    while (glfwWindowShouldClose(window_.handle()) == GLFW_FALSE) {
        try {
            interrupt.advance(0);
        } catch (const Interrupted&) {
            keepViews();
            if (log_) log_->finish();
            throw;
        }
        waitForEvents();
        const double seconds = now() - lastFrame_;
        lastFrame_ = now();
        takeInput(seconds);
        watch();
        if (file_.scene() != nullptr && !walk_.isUnderWay()) recentViews().see(walk_.control().camera(), now());
        const bool hasDrawn = drawFrame();
        if (isScripted() && file_.build() == nullptr && !walk_.isPlaying())
            throw Error(options_.path, "the path was not played to its end");
        if (!hasDrawn || walk_.advance(now() - lastFrame_)) continue;
        scheduler_.requestScene();
        if (isScripted()) break; // all requested images are written
    }
    keepViews();
    if (log_) log_->finish();
    // Ends the process at once, because a build that is reading a mesh would react too late to a stop request.
    if (file_.build() != nullptr) TemporaryName::removeAllAndExit(0);
}

void WindowSession::open(const std::string& file) {
    keepViews();
    file_.open(file);
    scheduler_.requestScene();
}

void WindowSession::enter(const Scene& scene) {
    const hierarchy::ModelFile& model = scene.model();
    FramedModel framed(options_.settings, model);
    framed.enter(walk_, settings_.asked, framebufferSize());
    framed_ = std::move(framed);
    caps_.pages = model.pages().size();
    if (!isAmong(colorChoices(model.summary(), scene.capabilities()), settings_.colors)) {
        messages_.fail(
            model.path() +
            ": the model does not have the value that the colours show; it is drawn with its own colours");
        settings_.colors = {};
    }
    saved_ = SavedFiles(model.path());
    pictureDue_.reset(); // the pending image was of another model
    measuring_ = Measuring(inspect::surveyedOf(model.path(), model.summary(), framed_->up()));
    glfwSetWindowTitle(window_.handle(), ("Gnomon - " + printable(model.path())).c_str());
    scheduler_.requestScene();
    if (!options_.path.empty() && frameCount_ == 0) walk_.togglePlaying(saved_);
}

void WindowSession::watch() {
    if (file_.build() != nullptr) scheduler_.requestOverlay();
    file_.watchBuild();
    if (file_.watchFile()) scheduler_.keepScene();
    if (messages_.expire()) scheduler_.requestOverlay();
}

void WindowSession::waitForEvents() {
    input_.beginFrame();
    input_.setMouseTaken(imgui_.wantsMouse());
    if (isIdle() && !scheduler_.needsOverlay() && !isRefining()) {
        glfwWaitEventsTimeout(kIdleSeconds);
        // Time without frames must not advance the animation.
        lastFrame_ = std::max(lastFrame_, now() - 1.0 / 60);
    } else {
        glfwPollEvents();
    }
    if (input_.hasHappened()) scheduler_.requestOverlay();
}

/// Returns true if the window waits for input after the next frame, so that this frame may take longer.
bool WindowSession::comesToRest() const {
    const frame::Frame* frame = file_.scene()->frame();
    const bool isMissing = frame == nullptr || frame->row.pagesMissing.value_or(0) > 0;
    return scheduler_.isLastOfScene() && !isMissing && !walk_.isUnderWay();
}

/// Returns true if the antialiased image of a resting view still needs more frames for its mean.
bool WindowSession::isRefining() const {
    const Scene* scene = file_.scene();
    return scene != nullptr && isIdle() && scene->samples() > 0 && scene->samples() < scene->wantedSamples();
}

/// Adds frames to the mean of a resting view for about 0.02 s, so that the window does not block. Showing the mean also
/// takes time, so not each frame is shown.
void WindowSession::refine() {
    constexpr double kSeconds = 0.02;
    constexpr double kBetweenShown = 0.12;
    const double end = now() + kSeconds;
    messages_.attempt([&] {
        do
            file_.scene()->addSample();
        while (isRefining() && now() < end);
    });
    if (isRefining() && now() < lastShown_ + kBetweenShown) return;
    scheduler_.keepOverlay();
}

QualityLevel WindowSession::wantedQuality() const {
    const plan::Quality& quality = settings_.asked.quality;
    QualityLevel level{quality.errorPixels, quality.zPartitions, quality.shadowTexelsWidth, quality.shadowTexelsHeight};
    level.mayBeExact = quality.shadows == plan::ShadowMode::Auto && !quality.mapsBecause;
    return level;
}

/// Returns true if frames must stay within the target time. This is the case if the view is moving, and no path with a
/// fixed number of frames is playing.
bool WindowSession::isHurried() const {
    const bool rests = !walk_.isUnderWay() && scheduler_.isSettled(true);
    return settings_.targetMs > 0 && !walk_.playsFixed() && !rests;
}

/// Returns the input of the next frame, whose image has `size` pixels. A frame of a resting view (`isStill`) ignores
/// the target time.
Shot WindowSession::shot(const glm::ivec2& size, bool isStill) const {
    Shot shot;
    shot.view.towardsLight = settings_.asked.towardsLight;
    shot.view.pointLight = framed_->pointLight(settings_.asked);
    shot.view.sunAngleRadians = settings::lightDiameter(settings_.asked);
    shot.view.up = framed_->up();
    settings::setSections(settings_.asked, shot.view);
    shot.view.camera = walk_.culledBy();
    shot.quality = settings_.asked.quality;
    const QualityLevel level = isHurried() && !isStill ? governor_.level(wantedQuality()) : wantedQuality();
    shot.view.width = drawnSide(size.x, level.resolution);
    shot.view.height = drawnSide(size.y, level.resolution);
    shot.quality.errorPixels = level.errorPixels * level.resolution;
    shot.quality.zPartitions = level.slices;
    shot.quality.shadowTexelsWidth = level.texelsWidth;
    shot.quality.shadowTexelsHeight = level.texelsHeight;
    if (!level.mayBeExact && !shot.quality.mapsBecause) shot.quality.mapsBecause = plan::ShadowReason::FrameTime;
    shot.options.overlay = settings_.overlay;
    if (settings_.overlay == render::Overlay::None) shot.colors = settings_.colors;
    const bool isColored = shot.colors.by != settings::ColorBy::None;
    shot.options.wantsSurfaces = isColored;
    shot.measuresAliasing = comesToRest();
    shot.options.isAccumulated =
        isStill && options_.samples > 1 && settings_.overlay == render::Overlay::None && !isColored;
    shot.samples = options_.samples;
    shot.options.waiting = walk_.playsFixed() ? frame::Waiting::UntilComplete : frame::Waiting::Never;
    if (walk_.isFrozen()) shot.options.observerCamera = walk_.camera();
    return shot;
}

bool WindowSession::drawFrame() {
    const glm::ivec2 size = framebufferSize();
    if (size.x < 1 || size.y < 1) { // minimised
        glfwWaitEventsTimeout(kIdleSeconds);
        return false;
    }
    const Scene* scene = file_.scene();
    const frame::Frame* frame = scene != nullptr ? scene->frame() : nullptr;
    if (frame != nullptr && drawnFor_ != size) scheduler_.requestScene();
    const bool drawsScene = scene != nullptr && !isIdle();
    if (pictureDue_ && pictureDue_->changes != scheduler_.changes()) savePictureOf(pictureDue_->shot);
    if (drawsScene)
        drawScene(size);
    else if (isRefining())
        refine();
    if (scene != nullptr) savePictureOnceDone();
    const bool drawsWindow = drawsScene || scheduler_.needsOverlay();
    scheduler_.countOverlay(); // before drawing, which may request another frame
    if (drawsWindow) drawWindow(size);
    return drawsScene;
}

void WindowSession::drawScene(const glm::ivec2& size) {
    if (settings_.targetMs > 0 && !walk_.isUnderWay() && scheduler_.isSettled(true)) scheduler_.settle();
    const bool isMeasured = isHurried();
    const bool rests = comesToRest();
    if (rests) file_.scene()->forget(); // so that the resting image is identical to the output of `gnomon render`
    const Shot shot = this->shot(size, rests);
    drawnFor_ = size;
    scheduler_.countScene();
    if (messages_.attempt([&] { file_.scene()->draw(shot); })) {
        afterScene(shot, isMeasured);
        // The last missing page may have arrived during this frame, so that the resting image needs another frame.
        if (!rests && file_.scene()->frame()->row.pagesMissing.value_or(0) == 0) scheduler_.keepScene();
        return;
    }
    scheduler_.stopScene();
    scheduler_.requestOverlay();
    walk_.stop();
}

void WindowSession::afterScene(const Shot& shot, bool isMeasured) {
    Scene& scene = *file_.scene();
    const plan::FramePlan& plan = scene.frame()->plan;
    telemetry::FrameRow row = scene.frame()->row;
    history_.add(stageTimes(row, lastWindowMs_));
    const double milliseconds = row.totalMs.value_or(0) + lastWindowMs_;
    if (isMeasured)
        governor_.measure(
            loadOf(*scene.frame(), milliseconds, settings_.targetMs), settings_.targetMs, wantedQuality());
    // With parallel projection, the flying speed depends on the distance to the target.
    const double distance = walk_.control().distance();
    const bool isParallel = plan.view.camera.isParallel();
    walk_.control().see(isParallel ? SceneDepths{distance, distance} : SceneDepths{plan.near, plan.far}, 1.0 / 30);
    scheduler_.update(row);
    row.run = "view";
    row.width = drawnFor_.x;
    row.height = drawnFor_.y;
    row.frame = frameCount_++;
    row.timeS = now();
    row.sinceStartMs = telemetry::sinceProcessStart().count;
    if (log_) log_->add(row);
    walk_.record(shot.seenBy());
    if (walk_.isPlaying() && !options_.images.empty())
        if (!messages_.attempt([&] { saved_.savePlayed(options_.images, walk_.playedFrame(), scene.picture()); }))
            walk_.stop();
}

/// Saves the current view as an image. A moving view is drawn in full quality and saved at once. A resting view is
/// saved after its refinement.
void WindowSession::takePicture() {
    const bool isShownInFull = walk_.playsFixed() || (isIdle() && !isRefining());
    if (isShownInFull && file_.scene()->frame() != nullptr) return saveShownPicture();
    const Shot still = shot(framebufferSize(), true);
    if (walk_.isUnderWay())
        savePictureOf(still);
    else
        pictureDue_ = {still, scheduler_.changes()};
}

void WindowSession::savePictureOnceDone() {
    const bool getsBetter = (options_.samples > 1 || settings_.targetMs > 0) && (!isIdle() || isRefining());
    if (pictureDue_ && !getsBetter) saveShownPicture();
}

void WindowSession::saveShownPicture() {
    pictureDue_.reset();
    messages_.attempt([&] { messages_.note("saved " + saved_.savePicture(file_.scene()->picture())); });
}

/// Draws a view in full quality, which moving frames do not have, and saves it as an image. The window waits meanwhile.
void WindowSession::savePictureOf(Shot still) {
    constexpr double kMaxSeconds = 1; // for samples; the first one is always drawn
    pictureDue_.reset();
    messages_.attempt([&] {
        Scene& scene = *file_.scene();
        if (!scene.model().source().isRemote()) still.options.waiting = frame::Waiting::UntilComplete;
        scene.forget();
        scene.draw(still);
        const double end = now() + kMaxSeconds;
        while (scene.samples() > 0 && scene.samples() < scene.wantedSamples() && now() < end)
            scene.addSample();
        messages_.note("saved " + saved_.savePicture(scene.picture()));
    });
    scheduler_.requestScene();
    lastFrame_ = now();
}

OverlayContent WindowSession::content() const {
    OverlayContent content;
    content.scene = file_.scene();
    if (content.scene != nullptr) {
        content.camera = walk_.camera();
        content.flyingSpeed = walk_.control().speed();
    }
    content.history = &history_;
    content.reductions = isHurried() ? governor_.reductions(wantedQuality()) : "";
    content.isExhausted = governor_.isExhausted();
    content.caps = caps_;
    content.maxSamples = content.scene != nullptr ? content.scene->wantedSamples() : 1;
    content.measuring = measuring_.isOn() ? &measuring_ : nullptr;
    content.isFrozen = walk_.isFrozen();
    content.isRecording = walk_.isRecording();
    content.playedPart = walk_.playedPart();
    content.messages = &messages_.all();
    if (const CacheBuild* build = file_.build()) {
        content.build = build->status();
        content.buildOf = printable(build->meshPath());
    }
    return content;
}

void WindowSession::drawWindow(const glm::ivec2& size) {
    const double start = now();
    const gl::Api& gl = window_.context().api();
    gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.viewport(0, 0, size.x, size.y);
    const ShownPicture picture =
        file_.scene() != nullptr ? file_.scene()->shown(size, settings_.usesEyeDome) : ShownPicture();
    const std::array<float, 4> background = {0.13F, 0.14F, 0.16F, 1};
    if (picture.isOpaque)
        fill_.draw(picture.texture);
    else
        gl.clearNamedFramebufferfv(0, GL_COLOR, 0, background.data());
    imgui_.beginFrame();
    if (file_.scene() != nullptr && !picture.isOpaque) drawPicture(picture);
    const OverlayAnswer answer = drawOverlay(content(), settings_, pad_);
    imgui_.endFrame();
    if (savesWindow_) {
        savesWindow_ = false;
        messages_.attempt([&] { messages_.note("saved " + saved_.saveWindow(gl, size)); });
    }
    glfwSwapBuffers(window_.handle());
    messages_.attempt([&] { window_.context().check("window"); });
    lastShown_ = now();
    lastWindowMs_ = (lastShown_ - start) * 1000;
    if (answer.hasChanged) scheduler_.requestScene();
    if (answer.isUnfinished) scheduler_.keepOverlay();
    for (const Action action : answer.actions)
        act({.action = action});
}

void runViewer(const ViewerOptions& options, Progress& interrupt) {
    try {
        WindowSession(options).run(interrupt);
    } catch (const gl::NoDisplay& error) {
        throw Error(std::string(error.what()) + "; `gnomon render` draws without a window");
    }
}

} // namespace gnomon::viewer
