// Applies keys and mouse to the session of the window.
#include "settings/backend_choice.h"
#include "viewer/input/setting_keys.h"
#include "viewer/window_session.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gnomon::viewer {

namespace {

constexpr double kDefaultTargetMs = 33; // used if the options set no target

} // namespace

void WindowSession::takeInput(double seconds) {
    for (const std::string& file : input_.dropped())
        open(file);
    if (input_.hasNewScale()) imgui_.rescale();
    takePressesAndClicks();
    if (!walk_.hasEntered()) return;
    for (const Drag& drag : input_.drags())
        takeDrag(drag);
    CameraControl& control = walk_.control();
    if (walk_.isPlaying()) return; // the path moves the camera
    if (input_.wheel() != 0) {
        const std::string said = turnWheel(input_.wheel(), input_.isHeldControl(), underCursor(), control);
        if (!said.empty()) messages_.show(said);
        scheduler_.requestScene();
    }
    if (input_.hasDoubleClicked() && !measuring_.isOn()) focus();
    const Flight flight = imgui_.wantsKeys() ? Flight{} : heldFlight([this](int key) { return input_.isHeld(key); });
    if (flight.direction != glm::dvec3(0) || control.isMoving()) {
        control.advance(flight, seconds);
        scheduler_.requestScene();
    }
}

/// Processes key presses and clicks in the order in which they arrived, because a key can remove or save the point of a
/// click.
void WindowSession::takePressesAndClicks() {
    std::size_t clicked = 0;
    const auto measureBefore = [&](std::size_t presses) {
        for (; clicked < input_.clicks().size() && input_.clicks()[clicked].pressesBefore <= presses; ++clicked)
            if (measuring_.isOn() && file_.scene() != nullptr) measure(input_.clicks()[clicked]);
    };
    for (std::size_t i = 0; i < input_.presses().size(); ++i) {
        measureBefore(i);
        const KeyPress& press = input_.presses()[i];
        const Binding* binding = imgui_.wantsKeys() ? nullptr : bindingOf(press.key, press.withShift);
        if (binding != nullptr) act(*binding);
    }
    measureBefore(input_.presses().size());
}

void WindowSession::takeDrag(const Drag& drag) {
    if (useOf(drag) == DragUse::Section) return dragSection(drag);
    const bool turnsLight = useOf(drag) == DragUse::Light;
    if (walk_.isPlaying() && !turnsLight) return;
    if (drag.moved != glm::dvec2(0)) scheduler_.requestScene(); // a press alone does not change the image
    if (turnsLight)
        turnLight(settings_.asked, walk_.control().camera(), drag.moved);
    else
        steering_.drag(drag, underCursor(), walk_.control());
}

void WindowSession::dragSection(const Drag& drag) {
    std::vector<settings::Section>& sections = settings_.asked.sections;
    if (sections.empty()) return messages_.show("no section to drag: J makes one");
    if (!file_.scene()->capabilities().sections)
        return messages_.show(settings::onlySoftware(&plan::Capabilities::sections));
    sectionDrag_.drag(drag, underCursor(), walk_.control().camera(), framebufferSize(), framed_->bounds(), sections);
    messages_.show(sectionInWords(sections[sectionDrag_.held()], framed_->bounds()));
    scheduler_.requestScene();
}

/// Converts a pixel of the window to a pixel of the last frame. The frame has fewer pixels if the quality governor has
/// reduced the resolution.
glm::ivec2 WindowSession::inFrame(const glm::ivec2& at) const {
    const plan::View& view = file_.scene()->frame()->plan.view;
    const glm::dvec2 scale = glm::dvec2(view.width, view.height) / glm::dvec2(glm::max(drawnFor_, glm::ivec2(1)));
    return {glm::dvec2(at) * scale};
}

/// Returns the world-space point that a pixel of the window shows.
std::optional<glm::dvec3> WindowSession::pick(const glm::ivec2& at) const {
    Scene& scene = *file_.scene();
    if (scene.frame() == nullptr) return std::nullopt;
    return scene.pick(inFrame(at));
}

void WindowSession::measure(const Click& click) {
    Scene& scene = *file_.scene();
    if (scene.frame() == nullptr) return;
    const std::optional<frame::DrawnPoint> drawn = scene.drawnPoint(inFrame(glm::ivec2(click.at)));
    if (!drawn) return messages_.show("nothing to measure here");
    const frame::GridPlace place = click.withShift ? drawn->vertex.value_or(drawn->point) : drawn->point;
    measuring_.take({place.cell, place.within});
}

/// Performs the action of a key for measurements. Returns false if the key has another purpose.
bool WindowSession::actOnMeasures(const Binding& binding) {
    switch (binding.action) {
    case Action::Measure:
        measuring_.toggle();
        return true;
    case Action::DropPoint:
        if (!measuring_.isOn() || !measuring_.dropLast()) messages_.show("no point to drop");
        return true;
    case Action::NextMeasure:
        if (!measuring_.isOn() || !measuring_.beginNext()) messages_.show("no measure to end");
        return true;
    case Action::SaveMeasures:
        if (measuring_.isEmpty())
            messages_.show("no measures yet: U takes them");
        else
            messages_.attempt(
                [&] { messages_.note("saved " + saved_.saveMeasures(measuring_.json(), measuring_.csv())); });
        return true;
    default:
        return false;
    }
}

/// Returns the recent views of the open model. The first call loads the stored views from disk.
RecentViews& WindowSession::recentViews() {
    const std::string& model = file_.scene()->model().path();
    const auto [found, isNew] = recent_.try_emplace(model);
    if (isNew) messages_.attempt([&, &views = found->second] { views = RecentViews(keptViews_.load(model)); });
    return found->second;
}

/// Stores the recent views on disk. After a failure it shows one message and stores no more views.
void WindowSession::keepViews() {
    const bool areKept = messages_.attempt([&] {
        for (const auto& [model, views] : recent_)
            keptViews_.save(model, views.cameras());
    });
    if (!areKept) keptViews_ = KeptViews("");
}

void WindowSession::goToRecent(int step) {
    RecentViews& views = recentViews();
    const std::optional<Camera> camera = step < 0 ? views.back() : views.forth();
    if (!camera) return messages_.show(step < 0 ? "no view before" : "no view behind");
    if (camera->projection != projection()) walk_.control().toggleProjection();
    walk_.control().goTo(*camera);
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
    governor_.relax();
    messages_.show(settings_.targetMs > 0 ? "time target: on" : "time target: none");
}

void WindowSession::act(const Binding& binding) {
    if (binding.action == Action::Leave) return glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
    if (file_.scene() != nullptr && actOnMeasures(binding)) return scheduler_.requestOverlay();
    if (binding.action != Action::Screenshot) scheduler_.requestScene();
    if (changeShown(binding, settings_)) return;
    if (binding.action == Action::ToggleTarget) return toggleTarget();
    if (file_.scene() != nullptr) actOnModel(binding);
}

void WindowSession::actOnModel(const Binding& binding) {
    if (const auto set = changeQuality(binding, settings_.asked)) return messages_.show(*set);
    const bool isOfSections = binding.action == Action::ToggleSection || binding.action == Action::MoveSection;
    if (isOfSections && !file_.scene()->capabilities().sections)
        return messages_.show(settings::onlySoftware(&plan::Capabilities::sections));
    if (const auto set = changeSection(binding, settings_.asked, framed_->bounds(), framed_->up()))
        return messages_.show(*set);
    if (!walk_.isUnderWay()) recentViews().stay(walk_.camera()); // the key may leave this view
    switch (binding.action) {
    case Action::StepColors:
        settings_.overlay = render::Overlay::None;
        return messages_.show(stepColors(
            colorChoices(file_.scene()->model().summary(), file_.scene()->capabilities()),
            binding.value,
            settings_.colors));
    case Action::RecentView:
        return goToRecent(binding.value);
    case Action::Focus:
        return focus();
    case Action::LookFrom:
        return walk_.control().goTo(
            framed_->from(static_cast<path::ViewSide>(binding.value), framebufferSize(), projection()));
    case Action::GoHome:
        return walk_.control().goTo(framed_->home(framebufferSize(), projection()));
    case Action::ToggleProjection:
        walk_.control().toggleProjection();
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
        if (binding.value == 0) return takePicture();
        savesWindow_ = true;
        return;
    case Action::Reload:
        return open(std::string(file_.scene()->model().path()));
    default:
        return; // Fly is processed while its key is held
    }
}

} // namespace gnomon::viewer
