#include "viewer/viewer.h"

#include "gl/window.h"
#include "path/camera_path.h"
#include "settings/resolve.h"
#include "telemetry/process_clock.h"
#include "viewer/frame_log.h"
#include "viewer/input/input.h"
#include "viewer/input/setting_keys.h"
#include "viewer/input/steering.h"
#include "viewer/open_file.h"
#include "viewer/pace.h"
#include "viewer/panel/imgui_layer.h"
#include "viewer/panel/overlay.h"
#include "viewer/walk.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace gnomon::viewer {

namespace {

constexpr double kDefaultTargetMs = 33;
constexpr double kIdleSeconds = 0.25;
constexpr std::size_t kHistory = 240;
constexpr int kPadSide = 33;

double now() {
    return glfwGetTime();
}

/// The window: takes user input to where it belongs, and draws what comes of it.
class Viewer {
public:
    explicit Viewer(const ViewerOptions& options);

    /// Until the window is closed, or `interrupt` says that the program is.
    void run(Progress& interrupt);

private:
    glm::ivec2 framebufferSize() const {
        glm::ivec2 size(0);
        glfwGetFramebufferSize(window_.handle(), &size.x, &size.y);
        return size;
    }

    void open(const std::string& file);
    void enter(const Scene& scene);
    void watch();

    void waitForEvents();
    void takeInput(double seconds);
    void takeDrag(const Drag& drag);
    DragScene underCursor() const;
    void act(const Binding& binding);
    void actOnModel(const Binding& binding);
    void toggleTarget();
    void focus();

    bool isIdle() const { return !pace_.isSceneAwake() && !walk_.isUnderWay(); }

    bool comesToRest() const;
    Effort wantedEffort() const;
    Shot shot(const glm::ivec2& size) const;
    bool drawFrame(); // whether the scene was drawn
    void drawScene(const glm::ivec2& size);
    void afterScene(const Shot& shot);
    OverlayContent content() const;
    void drawWindow(const glm::ivec2& size);

    ViewerOptions options_;
    ViewSettings settings_;
    gl::Window window_;
    Input input_;
    ImGuiLayer imgui_;
    Messages messages_{now, options_.tell};
    OpenFile file_;
    Walk walk_;
    Steering steering_;
    Pace pace_;
    DetailBudget budget_;
    FrameHistory history_{kHistory};
    StoragePad pad_{kPadSide};
    SavedFiles saved_;
    std::optional<FrameLog> log_;
    Caps caps_;
    double lastFrame_ = 0; // seconds on GLFW's clock
    double lastWindowMs_ = 0;
    std::int64_t frameCount_ = 0;
    bool savesPicture_ = false; // once all input until now is drawn
    bool savesWindow_ = false;
};

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      window_([&] {
          const auto [width, height] = options.settings.imageSize;
          return gl::Window("Gnomon", width, height);
      }()),
      input_(window_.handle()),
      imgui_(window_.handle()),
      file_(options_, window_.context(), messages_, now, [this](const Scene& scene) { enter(scene); }),
      walk_(
          messages_,
          now,
          options.path.empty() ? std::nullopt : std::optional(path::readCameraPath(options.path)),
          options.frames) {
    settings_.asked = options_.settings;
    settings_.asked.quality = settings::qualityOf(options_.settings);
    settings_.targetMs = options_.targetMs;
    caps_.memoryBytes = options_.settings.memory.count;
    caps_.gpuMemoryBytes = options_.settings.gpuMemory.count;
    if (!options_.csv.empty()) log_.emplace(options_.csv);
    open(options_.file);
    lastFrame_ = now();
}

void Viewer::run(Progress& interrupt) {
    while (glfwWindowShouldClose(window_.handle()) == GLFW_FALSE) {
        try {
            interrupt.advance(0);
        } catch (const Interrupted&) {
            if (log_) log_->finish();
            throw;
        }
        waitForEvents();
        const double seconds = now() - lastFrame_;
        lastFrame_ = now();
        takeInput(seconds);
        watch();
        if (!drawFrame() || walk_.advance(now() - lastFrame_)) continue;
        pace_.wakeScene();
        if (!options_.path.empty() && !options_.images.empty()) break; // all that was asked for is there
    }
    if (log_) log_->finish();
}

void Viewer::open(const std::string& file) {
    file_.open(file);
    pace_.wakeScene();
}

void Viewer::enter(const Scene& scene) {
    const hierarchy::ModelFile& model = scene.model();
    walk_.enter(settings::viewOf(options_.settings, model.summary()).camera, model.summary().bounds);
    caps_.pages = model.pages().size();
    saved_ = SavedFiles(model.path());
    glfwSetWindowTitle(window_.handle(), ("Gnomon - " + model.path()).c_str());
    pace_.wakeScene();
    if (!options_.path.empty() && frameCount_ == 0) walk_.togglePlaying(saved_);
}

void Viewer::watch() {
    if (file_.build() != nullptr) pace_.wakeWindow();
    file_.watchBuild();
    file_.watchFile();
    if (messages_.expire()) pace_.wakeWindow();
}

void Viewer::waitForEvents() {
    input_.beginFrame();
    input_.setMouseTaken(imgui_.wantsMouse());
    if (isIdle() && !pace_.isWindowAwake()) {
        glfwWaitEventsTimeout(kIdleSeconds);
        // Time that nothing moved in is no time to move on by.
        lastFrame_ = std::max(lastFrame_, now() - 1.0 / 60);
    } else {
        glfwPollEvents();
    }
    if (input_.hasHappened()) pace_.wakeWindow();
}

void Viewer::takeInput(double seconds) {
    for (const std::string& file : input_.dropped())
        open(file);
    if (input_.hasNewScale()) imgui_.rescale();
    if (!imgui_.wantsKeys())
        for (const KeyPress& press : input_.presses())
            if (const Binding* binding = bindingOf(press.key, press.withShift)) act(*binding);
    if (!walk_.hasEntered()) return;
    for (const Drag& drag : input_.drags())
        takeDrag(drag);
    CameraControl& control = walk_.control();
    if (walk_.isPlaying()) return; // the path has the camera
    if (input_.wheel() != 0) {
        const std::string said = turnWheel(input_.wheel(), input_.isHeldControl(), underCursor(), control);
        if (!said.empty()) messages_.show(said);
        pace_.wakeScene();
    }
    if (input_.hasDoubleClicked()) focus();
    const Flight flight = imgui_.wantsKeys() ? Flight{} : heldFlight([this](int key) { return input_.isHeld(key); });
    if (flight.direction != glm::dvec3(0) || control.isMoving()) {
        control.advance(flight, seconds);
        pace_.wakeScene();
    }
}

void Viewer::takeDrag(const Drag& drag) {
    const bool turnsLight = useOf(drag) == DragUse::Light;
    if (walk_.isPlaying() && !turnsLight) return;
    pace_.wakeScene();
    if (turnsLight)
        settings_.asked.towardsLight = turnedLight(walk_.control().camera(), settings_.asked.towardsLight, drag.moved);
    else
        steering_.drag(drag, underCursor(), walk_.control());
}

DragScene Viewer::underCursor() const {
    return {input_.cursor(), framebufferSize().y, [this](const glm::ivec2& at) { return file_.scene()->pick(at); }};
}

void Viewer::focus() {
    if (const auto point = file_.scene()->pick(glm::ivec2(input_.cursor())))
        walk_.control().focusOn(*point);
    else
        messages_.show("nothing under the cursor");
}

void Viewer::toggleTarget() {
    const double wanted = options_.targetMs > 0 ? options_.targetMs : kDefaultTargetMs;
    settings_.targetMs = settings_.targetMs > 0 ? 0 : wanted;
    budget_.relax();
    messages_.show(settings_.targetMs > 0 ? "time target: on" : "time target: none");
}

void Viewer::act(const Binding& binding) {
    pace_.wakeScene();
    if (changeShown(binding, settings_)) return;
    if (binding.action == Action::Leave) return glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
    if (binding.action == Action::ToggleTarget) return toggleTarget();
    if (file_.scene() != nullptr) actOnModel(binding);
}

void Viewer::actOnModel(const Binding& binding) {
    if (const auto set = changeQuality(binding, settings_.asked)) return messages_.show(*set);
    switch (binding.action) {
    case Action::Focus:
        return focus();
    case Action::LookFrom:
        return walk_.control().goTo(static_cast<Side>(binding.value));
    case Action::GoHome:
        return walk_.control().goHome();
    case Action::Freeze:
        return walk_.toggleFreeze();
    case Action::Record:
        return walk_.toggleRecording(saved_);
    case Action::Play:
        if (walk_.togglePlaying(saved_)) file_.scene()->forget();
        return;
    case Action::Screenshot:
        (binding.value == 1 ? savesWindow_ : savesPicture_) = true;
        return;
    case Action::Reload:
        return open(std::string(file_.scene()->model().path()));
    default:
        return; // Fly counts as long as its key is held
    }
}

/// Whether the next frame is the last before the window waits for input: that one may take its time.
bool Viewer::comesToRest() const {
    const frame::Frame* frame = file_.scene()->frame();
    const bool isMissing = frame == nullptr || frame->row.pagesMissing.value_or(0) > 0;
    return pace_.isLastOfScene() && !isMissing && !walk_.isUnderWay();
}

Effort Viewer::wantedEffort() const {
    return {settings_.asked.quality.errorPixels, settings_.asked.quality.zPartitions};
}

Shot Viewer::shot(const glm::ivec2& size) const {
    Shot shot;
    shot.view.width = size.x;
    shot.view.height = size.y;
    shot.view.towardsLight = settings_.asked.towardsLight;
    shot.view.up = settings_.asked.up.value_or(shot.view.up);
    shot.view.camera = walk_.culledBy();
    shot.quality = settings_.asked.quality;
    if (settings_.targetMs > 0 && !walk_.playsFixed()) {
        const Effort effort = budget_.effort(wantedEffort());
        shot.quality.errorPixels = effort.errorPixels;
        shot.quality.zPartitions = effort.slices;
    }
    shot.options.overlay = settings_.overlay;
    shot.measuresAliasing = comesToRest();
    shot.options.waiting = walk_.playsFixed() ? frame::Waiting::UntilComplete : frame::Waiting::Never;
    if (walk_.isFrozen()) shot.options.observerCamera = walk_.camera();
    return shot;
}

bool Viewer::drawFrame() {
    const glm::ivec2 size = framebufferSize();
    if (size.x < 1 || size.y < 1) { // minimised
        glfwWaitEventsTimeout(kIdleSeconds);
        return false;
    }
    const Scene* scene = file_.scene();
    const frame::Frame* frame = scene != nullptr ? scene->frame() : nullptr;
    if (frame != nullptr && (frame->plan.view.width != size.x || frame->plan.view.height != size.y)) pace_.wakeScene();
    const bool drawsScene = scene != nullptr && !isIdle();
    if (drawsScene) drawScene(size);
    const bool drawsWindow = drawsScene || pace_.isWindowAwake();
    pace_.countWindow(); // first, since drawing it may ask for one more
    if (drawsWindow) drawWindow(size);
    return drawsScene;
}

void Viewer::drawScene(const glm::ivec2& size) {
    const Shot shot = this->shot(size);
    pace_.countScene();
    if (messages_.attempt([&] { file_.scene()->draw(shot); })) return afterScene(shot);
    pace_.stopScene();
    pace_.wakeWindow();
    walk_.stop();
}

void Viewer::afterScene(const Shot& shot) {
    Scene& scene = *file_.scene();
    const plan::FramePlan& plan = scene.frame()->plan;
    telemetry::FrameRow row = scene.frame()->row;
    history_.add(stageTimes(row, lastWindowMs_));
    if (settings_.targetMs > 0 && !walk_.playsFixed())
        budget_.measure(row.totalMs.value_or(0) + lastWindowMs_, settings_.targetMs);
    walk_.control().see({plan.near, plan.far}, 1.0 / 30);
    pace_.see(row);
    row.run = "view";
    row.frame = frameCount_++;
    row.timeS = now();
    row.sinceStartMs = telemetry::sinceProcessStart().count;
    if (log_) log_->add(row);
    walk_.record(shot.seenBy());
    if (savesPicture_) {
        savesPicture_ = false;
        messages_.attempt([&] { messages_.note("saved " + saved_.savePicture(scene.picture())); });
    }
    if (walk_.isPlaying() && !options_.images.empty())
        messages_.attempt([&] { saved_.savePlayed(options_.images, walk_.playedFrame(), scene.picture()); });
}

OverlayContent Viewer::content() const {
    OverlayContent content;
    content.scene = file_.scene();
    if (content.scene != nullptr) {
        content.camera = walk_.camera();
        content.flyingSpeed = walk_.control().speed();
    }
    content.history = &history_;
    content.budget = &budget_;
    content.wanted = wantedEffort();
    content.caps = caps_;
    content.isFrozen = walk_.isFrozen();
    content.isRecording = walk_.isRecording();
    content.playedPart = walk_.playedPart();
    content.messages = &messages_.all();
    if (const CacheBuild* build = file_.build()) {
        content.build = build->status();
        content.buildOf = build->meshPath();
    }
    return content;
}

void Viewer::drawWindow(const glm::ivec2& size) {
    const double start = now();
    const gl::Api& gl = window_.context().api();
    gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.viewport(0, 0, size.x, size.y);
    const std::array<float, 4> background = {0.13F, 0.14F, 0.16F, 1};
    gl.clearNamedFramebufferfv(0, GL_COLOR, 0, background.data());
    imgui_.beginFrame();
    if (file_.scene() != nullptr) drawPicture(file_.scene()->shown());
    const OverlayAnswer answer = drawOverlay(content(), settings_, pad_);
    imgui_.endFrame();
    if (savesWindow_) {
        savesWindow_ = false;
        messages_.attempt([&] { messages_.note("saved " + saved_.saveWindow(gl, size)); });
    }
    glfwSwapBuffers(window_.handle());
    messages_.attempt([&] { window_.context().check("window"); });
    lastWindowMs_ = (now() - start) * 1000;
    if (answer.hasChanged) pace_.wakeScene();
    if (answer.isUnfinished) pace_.keepWindow();
    for (const Action action : answer.actions)
        act({.action = action});
}

} // namespace

void runViewer(const ViewerOptions& options, Progress& interrupt) {
    try {
        Viewer(options).run(interrupt);
    } catch (const gl::NoDisplay& error) {
        throw Error(std::string(error.what()) + "; `gnomon render` draws without one");
    }
}

} // namespace gnomon::viewer
