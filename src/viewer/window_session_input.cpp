// What the window session does with keys and mouse.
#include "viewer/input/setting_keys.h"
#include "viewer/window_session.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gnomon::viewer {

namespace {

constexpr double kDefaultTargetMs = 33; // where it was asked to have none

} // namespace

void WindowSession::takeInput(double seconds) {
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

void WindowSession::takeDrag(const Drag& drag) {
    const bool turnsLight = useOf(drag) == DragUse::Light;
    if (walk_.isPlaying() && !turnsLight) return;
    pace_.wakeScene();
    if (turnsLight)
        turnLight(settings_.asked, walk_.control().camera(), drag.moved);
    else
        steering_.drag(drag, underCursor(), walk_.control());
}

/// The world point under a pixel of the window.
std::optional<glm::dvec3> WindowSession::pick(const glm::ivec2& at) const {
    Scene& scene = *file_.scene();
    if (scene.frame() == nullptr) return std::nullopt;
    const plan::View& view = scene.frame()->plan.view; // of fewer pixels while time is short
    const glm::dvec2 scale = glm::dvec2(view.width, view.height) / glm::dvec2(glm::max(drawnFor_, glm::ivec2(1)));
    return scene.pick(glm::ivec2(glm::dvec2(at) * scale));
}

DragScene WindowSession::underCursor() const {
    return {input_.cursor(), framebufferSize().y, [this](const glm::ivec2& at) { return pick(at); }};
}

void WindowSession::focus() {
    if (const auto point = pick(glm::ivec2(input_.cursor())))
        walk_.control().focusOn(*point);
    else
        messages_.show("nothing under the cursor");
}

void WindowSession::toggleTarget() {
    const double wanted = options_.targetMs > 0 ? options_.targetMs : kDefaultTargetMs;
    settings_.targetMs = settings_.targetMs > 0 ? 0 : wanted;
    budget_.relax();
    messages_.show(settings_.targetMs > 0 ? "time target: on" : "time target: none");
}

void WindowSession::act(const Binding& binding) {
    if (binding.action == Action::Leave) return glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
    if (binding.action != Action::Screenshot) pace_.wakeScene();
    if (changeShown(binding, settings_)) return;
    if (binding.action == Action::ToggleTarget) return toggleTarget();
    if (file_.scene() != nullptr) actOnModel(binding);
}

void WindowSession::actOnModel(const Binding& binding) {
    if (const auto set = changeQuality(binding, settings_.asked)) return messages_.show(*set);
    const bool isOfSections = binding.action == Action::ToggleSection || binding.action == Action::MoveSection;
    if (isOfSections && !file_.scene()->drawsSections())
        return messages_.show("only the software executor draws sections");
    if (const auto set = changeSection(binding, settings_.asked, framed_->bounds(), framed_->up()))
        return messages_.show(*set);
    switch (binding.action) {
    case Action::Focus:
        return focus();
    case Action::LookFrom:
        return walk_.control().goTo(
            framed_->from(static_cast<path::ViewSide>(binding.value), framebufferSize(), projection()));
    case Action::GoHome:
        return walk_.control().goTo(framed_->home(framebufferSize(), projection()));
    case Action::ToggleProjection:
        walk_.control().toggleProjection();
        file_.scene()->forget();
        return messages_.show(std::string(wordOf(kProjections, projection())));
    case Action::SaveCamera:
        messages_.attempt([&] { messages_.note("saved " + saved_.saveCamera(walk_.camera())); });
        return;
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

} // namespace gnomon::viewer
