#include "app/view/viewer.h"

#include "app/option_text.h"
#include "app/view/camera_control.h"
#include "app/view/frame_log.h"
#include "app/view/imgui_layer.h"
#include "app/view/input.h"
#include "app/view/overlay.h"
#include "app/view/path_recorder.h"
#include "app/view/saved_files.h"
#include "app/view/steering.h"
#include "gl/window.h"
#include "telemetry/process_clock.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace gnomon::app::view {

namespace {

constexpr double kDefaultTargetMs = 33;
constexpr double kIdleSeconds = 0.25;
constexpr double kWatchSeconds = 1; // between looks at the model's file
// After the last change frames are drawn until what has hysteresis has come to rest.
constexpr int kSettlingFrames = 16;
constexpr int kUnansweredFrames = 60; // with pages missing of which none comes
constexpr int kUiFrames = 3;          // Dear ImGui needs more than one to lay out what is new
constexpr std::size_t kHistory = 240;
constexpr int kPadSide = 33;

/// The window and all that it remembers.
class Viewer {
public:
    explicit Viewer(const ViewerOptions& options);

    void run();

private:
    static double now() { return glfwGetTime(); }

    glm::ivec2 framebufferSize() const {
        glm::ivec2 size(0);
        glfwGetFramebufferSize(window_.handle(), &size.x, &size.y);
        return size;
    }

    void open(const std::string& file);
    void openModel(const std::string& path);
    void watchBuild();
    void watchFile();

    void takeInput(double seconds);
    void takeDrag(const Drag& drag);
    void act(Action action, int value);
    void actOnQuality(Action action, int value);
    void toggleFreeze();
    void toggleRecording();
    void togglePlaying();
    void toggleTarget();
    void focus();

    void advance(double seconds);
    void waitForEvents();
    bool isIdle() const;
    bool drawFrame(); // whether the scene was drawn
    void drawScene(const glm::ivec2& size);
    void afterScene(const Shot& shot);
    void drawWindow(const glm::ivec2& size);
    void saveShot(bool withOverlay);

    Shot shot(const glm::ivec2& size) const;
    Effort wantedEffort() const;
    bool comesToRest() const;

    bool playsFixed() const { return player_ && player_->hasFixedStep(); }

    /// Something has changed that the next frames must show.
    void touch() { settling_ = kSettlingFrames; }

    /// `action` with what it throws told in the window.
    template <class Do>
    bool attempt(const Do& action) {
        try {
            action();
            return true;
        } catch (const std::exception& error) {
            messages_.fail(error.what(), now());
            return false;
        }
    }

    ViewerOptions options_;
    ViewSettings settings_;
    gl::Window window_;
    Input input_;
    ImGuiLayer imgui_;
    Messages messages_;
    std::unique_ptr<Scene> scene_;
    std::unique_ptr<CacheBuild> build_;
    std::optional<CameraControl> control_;
    std::optional<Camera> frozen_; // whose cut and maps are shown from outside
    std::optional<PathRecorder> recorder_;
    std::optional<PathPlayer> player_;
    std::optional<CameraPath> path_; // to be played
    std::optional<FrameLog> log_;
    DetailBudget budget_;
    FrameHistory history_{kHistory};
    StoragePad pad_{kPadSide};
    SavedFiles saved_;
    Caps caps_;
    FileFate fate_ = FileFate::Same;
    Steering steering_;
    double lastFrame_ = 0; // seconds on GLFW's clock
    double lastWatch_ = 0;
    double lastWindowMs_ = 0;
    int settling_ = kSettlingFrames;
    int uiFrames_ = kUiFrames;
    int unanswered_ = 0;
    std::int64_t bytesRead_ = 0;
    std::int64_t frameCount_ = 0;
    bool savesPicture_ = false;
    bool savesWindow_ = false;
};

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      window_([&] {
          const auto [width, height] = imageSize(options.view);
          return gl::Window("Gnomon", width, height);
      }()),
      input_(window_.handle()),
      imgui_(window_.handle()) {
    settings_.quality = qualityOf(options_.view, options_.view.swept);
    settings_.towardsLight = parseVector("--light", options_.view.light);
    settings_.targetMs = options_.targetMs;
    caps_.memoryBytes = parseMemory("--memory", options_.view.memory).count;
    caps_.gpuMemoryBytes = parseMemory("--gpu-memory", options_.view.gpuMemory).count;
    if (!options_.csv.empty()) log_.emplace(options_.csv);
    if (!options_.path.empty()) path_ = readCameraPath(options_.path);
    open(options_.file);
    if (path_ && scene_) togglePlaying();
    lastFrame_ = now();
}

void Viewer::run() {
    CommonOptions silent;
    silent.progress = "none";
    const auto interrupt = makeProgress(silent); // throws on Ctrl-C
    while (glfwWindowShouldClose(window_.handle()) == GLFW_FALSE) {
        try {
            interrupt->advance(0);
        } catch (const Interrupted&) {
            if (log_) log_->finish();
            throw;
        }
        waitForEvents();
        const double seconds = now() - lastFrame_;
        lastFrame_ = now();
        takeInput(seconds);
        watchBuild();
        watchFile();
        if (messages_.expire(now())) uiFrames_ = kUiFrames;
        if (drawFrame()) advance(now() - lastFrame_);
    }
    if (log_) log_->finish();
}

// --- models ---

void Viewer::open(const std::string& file) {
    attempt([&] {
        if (isModelPath(file)) return openModel(file);
        if (isCacheFresh(file)) return openModel(cachePath(file));
        build_.reset();
        build_ =
            std::make_unique<CacheBuild>(file, parseMemory("--build-memory", options_.buildMemory), options_.threads);
    });
    touch();
}

void Viewer::openModel(const std::string& path) {
    auto scene = std::make_unique<Scene>(
        path, options_.view, window_.context(), [this](const std::string& reason) { messages_.fail(reason, now()); });
    const plan::View home = viewOf(options_.view, scene->model().summary());
    scene_ = std::move(scene);
    control_.emplace(home.camera, scene_->model().summary().bounds);
    caps_.pages = scene_->model().pages().size();
    fate_ = FileFate::Same;
    frozen_.reset();
    player_.reset();
    recorder_.reset();
    saved_ = SavedFiles(path);
    glfwSetWindowTitle(window_.handle(), ("Gnomon - " + path).c_str());
    touch();
}

void Viewer::watchBuild() {
    if (!build_) return;
    uiFrames_ = kUiFrames;
    if (!build_->isDone()) return;
    const std::string mesh = build_->meshPath();
    const std::optional<std::string> failure = build_->failure();
    build_.reset();
    if (failure)
        messages_.fail(*failure, now());
    else if (attempt([&] { openModel(cachePath(mesh)); }))
        messages_.note("built " + cachePath(mesh), now());
    if (path_ && scene_ && frameCount_ == 0 && !options_.path.empty()) togglePlaying();
}

void Viewer::watchFile() {
    if (!scene_ || now() - lastWatch_ < kWatchSeconds) return;
    lastWatch_ = now();
    const FileFate fate = scene_->fate();
    if (fate == fate_) return;
    fate_ = fate;
    const std::string& path = scene_->model().path();
    if (fate == FileFate::Gone)
        messages_.fail(path + ": the model has vanished from disk; what is open stays open", now());
    if (fate == FileFate::Changed) messages_.fail(path + ": the model has changed on disk; F9 opens it again", now());
    if (fate == FileFate::Same) messages_.note(path + ": the model is back", now());
}

// --- the hand ---

void Viewer::waitForEvents() {
    input_.beginFrame();
    input_.setMouseTaken(imgui_.wantsMouse());
    if (isIdle() && uiFrames_ == 0) {
        glfwWaitEventsTimeout(kIdleSeconds);
        // Time that nothing moved in is no time to move on by.
        lastFrame_ = std::max(lastFrame_, now() - 1.0 / 60);
    } else {
        glfwPollEvents();
    }
    if (input_.hasHappened()) uiFrames_ = kUiFrames;
}

void Viewer::takeInput(double seconds) {
    for (const std::string& file : input_.dropped())
        open(file);
    if (input_.hasNewScale()) imgui_.rescale();
    if (!imgui_.wantsKeys())
        for (const KeyPress& press : input_.presses())
            if (const Binding* binding = bindingOf(press.key, press.withShift)) act(binding->action, binding->value);
    if (!control_) return;
    for (const Drag& drag : input_.drags())
        takeDrag(drag);
    if (input_.wheel() != 0) {
        control_->changeSpeed(input_.wheel());
        std::array<char, 48> text{};
        std::snprintf(text.data(), text.size(), "speed: %.3g a second", control_->speed());
        messages_.show(text.data(), now());
    }
    if (player_) return; // the path has the camera
    const Flight flight = imgui_.wantsKeys() ? Flight{} : heldFlight([this](int key) { return input_.isHeld(key); });
    if (flight.direction != glm::dvec3(0) || control_->isMoving()) {
        control_->advance(flight, seconds);
        touch();
    }
}

void Viewer::takeDrag(const Drag& drag) {
    if (player_ && drag.button != GLFW_MOUSE_BUTTON_RIGHT) return;
    touch();
    if (drag.button == GLFW_MOUSE_BUTTON_RIGHT)
        settings_.towardsLight = turnedLight(control_->camera(), settings_.towardsLight, drag.moved);
    else
        steering_.drag(
            drag,
            {input_.cursor(), framebufferSize().y, [this](const glm::ivec2& pixel) { return scene_->pick(pixel); }},
            *control_);
}

void Viewer::focus() {
    if (const auto point = scene_->pick(glm::ivec2(input_.cursor())))
        control_->focusOn(*point);
    else
        messages_.show("nothing under the cursor", now());
}

void Viewer::toggleFreeze() {
    if (frozen_)
        frozen_.reset();
    else
        frozen_ = control_->camera();
    messages_.show(frozen_ ? "culling is frozen: walk around it" : "culling follows the camera", now());
}

void Viewer::toggleTarget() {
    const double wanted = options_.targetMs > 0 ? options_.targetMs : kDefaultTargetMs;
    settings_.targetMs = settings_.targetMs > 0 ? 0 : wanted;
    budget_.relax();
    messages_.show(settings_.targetMs > 0 ? "time target: on" : "time target: none", now());
}

void Viewer::toggleRecording() {
    if (!recorder_) {
        recorder_.emplace();
        recorder_->add(now(), control_->camera());
        return messages_.show("recording: R ends it", now());
    }
    const std::optional<CameraPath> path = recorder_->path();
    recorder_.reset();
    if (!path) return;
    path_ = path;
    attempt([&] { messages_.note("saved " + saved_.savePath(*path), now()); });
}

void Viewer::togglePlaying() {
    if (player_) {
        control_->jumpTo(player_->camera());
        player_.reset();
        return messages_.show("path: stopped", now());
    }
    if (!path_) return messages_.show("no path yet: R records one", now());
    if (recorder_) toggleRecording();
    scene_->forget();
    player_.emplace(*path_, options_.frames);
}

void Viewer::actOnQuality(Action action, int value) {
    plan::Quality& quality = settings_.quality;
    switch (action) {
    case Action::StepScheme:
        return messages_.show(stepScheme(quality, value), now());
    case Action::StepWarp:
        return messages_.show(stepWarp(quality, value), now());
    case Action::StepSlices:
        return messages_.show(stepSlices(quality, value), now());
    case Action::StepFaces:
        return messages_.show(stepFaces(quality), now());
    case Action::StepTexels:
        return messages_.show(stepTexels(quality, value), now());
    case Action::StepFilter:
        return messages_.show(stepFilter(quality), now());
    case Action::StepDetail:
        return messages_.show(stepDetail(quality, value), now());
    case Action::ToggleCulling:
        return messages_.show(toggleCulling(quality), now());
    case Action::ToggleStabilising:
        return messages_.show(toggleStabilising(quality), now());
    default:
        return;
    }
}

void Viewer::act(Action action, int value) {
    touch();
    // What needs no model.
    switch (action) {
    case Action::Leave:
        return glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
    case Action::ToggleHelp:
        settings_.showsHelp = !settings_.showsHelp;
        return;
    case Action::TogglePanel:
        settings_.showsPanel = !settings_.showsPanel;
        return;
    case Action::ToggleFacts:
        settings_.showsFacts = !settings_.showsFacts;
        return;
    case Action::SetOverlay:
        settings_.overlay = overlayNames()[static_cast<std::size_t>(value)].overlay;
        return;
    case Action::ToggleTarget:
        return toggleTarget();
    default:
        break;
    }
    if (!scene_) return;
    switch (action) {
    case Action::Fly:
        return; // as long as it is held
    case Action::Focus:
        return focus();
    case Action::LookFrom:
        return control_->goTo(static_cast<Side>(value));
    case Action::GoHome:
        return control_->goHome();
    case Action::Freeze:
        return toggleFreeze();
    case Action::Record:
        return toggleRecording();
    case Action::Play:
        return togglePlaying();
    case Action::Screenshot:
        return saveShot(value == 1);
    case Action::Reload:
        return open(std::string(scene_->model().path()));
    default:
        return actOnQuality(action, value);
    }
}

void Viewer::saveShot(bool withOverlay) {
    // Once what the hand has done until now is drawn.
    if (withOverlay)
        savesWindow_ = true;
    else
        savesPicture_ = true;
}

// --- frames ---

bool Viewer::isIdle() const {
    return settling_ == 0 && !player_ && !recorder_ && (!control_ || !control_->isMoving());
}

/// Whether the next frame is the last before the window waits for the hand: that one may take its time.
bool Viewer::comesToRest() const {
    const bool isMissing = scene_->frame() == nullptr || scene_->frame()->row.pagesMissing.value_or(0) > 0;
    return settling_ == 1 && !isMissing && !player_ && !recorder_ && !control_->isMoving();
}

Effort Viewer::wantedEffort() const {
    return {settings_.quality.errorPixels, settings_.quality.zPartitions};
}

Shot Viewer::shot(const glm::ivec2& size) const {
    Shot shot;
    shot.view.width = size.x;
    shot.view.height = size.y;
    shot.view.towardsLight = settings_.towardsLight;
    const Camera camera = player_ ? player_->camera() : control_->camera();
    shot.view.camera = frozen_.value_or(camera);
    shot.quality = settings_.quality;
    if (settings_.targetMs > 0 && !playsFixed()) {
        const Effort effort = budget_.effort(wantedEffort());
        shot.quality.errorPixels = effort.errorPixels;
        shot.quality.zPartitions = effort.slices;
    }
    shot.options.overlay = settings_.overlay;
    shot.options.measuresAliasing = comesToRest();
    shot.options.waiting = playsFixed() ? render::Waiting::UntilComplete : render::Waiting::Never;
    if (frozen_) shot.options.onlooker = camera;
    return shot;
}

bool Viewer::drawFrame() {
    const glm::ivec2 size = framebufferSize();
    if (size.x < 1 || size.y < 1) { // minimised
        glfwWaitEventsTimeout(kIdleSeconds);
        return false;
    }
    const render::Frame* frame = scene_ ? scene_->frame() : nullptr;
    if (frame != nullptr && (frame->plan.view.width != size.x || frame->plan.view.height != size.y)) touch();
    const bool drawsScene = scene_ && !isIdle();
    if (drawsScene) drawScene(size);
    if (drawsScene || uiFrames_ > 0) drawWindow(size);
    if (uiFrames_ > 0) --uiFrames_;
    return drawsScene;
}

void Viewer::drawScene(const glm::ivec2& size) {
    const Shot shot = this->shot(size);
    if (settling_ > 0) --settling_;
    if (!attempt([&] { scene_->draw(shot); })) {
        settling_ = 0;
        player_.reset();
        uiFrames_ = kUiFrames;
        return;
    }
    afterScene(shot);
}

void Viewer::afterScene(const Shot& shot) {
    const render::Frame& frame = *scene_->frame();
    telemetry::FrameRow row = frame.row;
    history_.add(stageTimes(row, lastWindowMs_));
    if (settings_.targetMs > 0 && !playsFixed())
        budget_.measure(row.totalMs.value_or(0) + lastWindowMs_, settings_.targetMs);
    control_->see({frame.plan.near, frame.plan.far}, 1.0 / 30);
    // Pages on their way will change the picture, unless nothing has come for long.
    const bool isMissing = row.pagesMissing.value_or(0) > 0;
    unanswered_ = row.bytesRead.value_or(0) != bytesRead_ ? 0 : unanswered_ + 1;
    bytesRead_ = row.bytesRead.value_or(0);
    if (isMissing && unanswered_ < kUnansweredFrames) settling_ = std::max(settling_, 2);
    row.run = "view";
    row.frame = frameCount_++;
    row.timeS = now();
    row.sinceStartMs = telemetry::sinceProcessStart().count;
    if (log_) log_->add(row);
    if (recorder_) recorder_->add(now(), shot.seenBy());
    if (savesPicture_) {
        savesPicture_ = false;
        attempt([&] { messages_.note("saved " + saved_.savePicture(scene_->picture()), now()); });
    }
    if (player_ && !options_.images.empty())
        attempt([&] { saved_.savePlayed(options_.images, player_->frame(), scene_->picture()); });
}

void Viewer::drawWindow(const glm::ivec2& size) {
    const double start = now();
    const gl::Api& gl = window_.context().api();
    gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.viewport(0, 0, size.x, size.y);
    const std::array<float, 4> background = {0.13F, 0.14F, 0.16F, 1};
    gl.clearNamedFramebufferfv(0, GL_COLOR, 0, background.data());
    imgui_.beginFrame();
    OverlayContent content;
    content.scene = scene_.get();
    if (scene_) {
        drawPicture(scene_->shown());
        content.camera = player_ ? player_->camera() : control_->camera();
        content.flyingSpeed = control_->speed();
    }
    content.history = &history_;
    content.budget = &budget_;
    content.wanted = wantedEffort();
    content.caps = caps_;
    content.isFrozen = frozen_.has_value();
    content.isRecording = recorder_.has_value();
    content.playedPart = player_ ? player_->part() : -1;
    content.messages = &messages_.all();
    if (build_) {
        content.build = build_->status();
        content.buildOf = build_->meshPath();
    }
    const OverlayAnswer answer = drawOverlay(content, settings_, pad_);
    imgui_.endFrame();
    if (savesWindow_) {
        savesWindow_ = false;
        attempt([&] { messages_.note("saved " + saved_.saveWindow(gl, size), now()); });
    }
    glfwSwapBuffers(window_.handle());
    attempt([&] { window_.context().check("window"); });
    lastWindowMs_ = (now() - start) * 1000;
    if (answer.hasChanged) touch();
    if (answer.isUnfinished) uiFrames_ = std::max(uiFrames_, 1);
    for (const Action action : answer.actions)
        act(action, 0);
}

void Viewer::advance(double seconds) {
    if (!player_) return;
    const Camera last = player_->camera();
    if (player_->advance(seconds)) return;
    player_.reset();
    control_->jumpTo(last);
    messages_.note("path: played to its end", now());
    touch();
}

} // namespace

void runViewer(const ViewerOptions& options) {
    qualityOf(options.view, options.view.swept); // contradictions are told before a window opens
    imageSize(options.view);
    if (options.view.backend == "osmesa" || options.view.backend == "egl")
        throw UsageError{"--backend " + options.view.backend + " draws into no window; take auto, software or window"};
    if (!std::filesystem::exists(options.file))
        throw Error(options.file, "this model cannot be opened", "a file", "none");
    try {
        Viewer(options).run();
    } catch (const gl::NoDisplay& error) {
        throw Error(std::string(error.what()) + "; `gnomon render` draws without one");
    }
}

} // namespace gnomon::app::view
