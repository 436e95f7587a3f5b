// The session of a window: applies user input to the camera and the settings, and draws the result.
#pragma once

#include "core/progress.h"
#include "gl/picture_fill.h"
#include "gl/window.h"
#include "viewer/frame_log.h"
#include "viewer/framed_model.h"
#include "viewer/input/input.h"
#include "viewer/input/section_drag.h"
#include "viewer/input/steering.h"
#include "viewer/measuring.h"
#include "viewer/open_file.h"
#include "viewer/panel/imgui_layer.h"
#include "viewer/panel/overlay.h"
#include "viewer/quality_governor.h"
#include "viewer/recent/kept_views.h"
#include "viewer/recent/recent_views.h"
#include "viewer/redraw_scheduler.h"
#include "viewer/viewer_options.h"
#include "viewer/walk.h"

#include <map>
#include <string>

namespace gnomon::viewer {

/// A run of `gnomon view` from its first frame to its last.
class WindowSession {
public:
    explicit WindowSession(const ViewerOptions& options);

    /// Runs the window until it is closed or `interrupt` throws an exception.
    void run(Progress& interrupt);

private:
    glm::ivec2 framebufferSize() const;

    void open(const std::string& file);
    void enter(const Scene& scene);
    void watch();

    void waitForEvents();
    void takeInput(double seconds);
    void takePressesAndClicks();
    void takeDrag(const Drag& drag);
    void dragSection(const Drag& drag);
    std::optional<glm::dvec3> pick(const glm::ivec2& at) const;
    DragScene underCursor() const;
    void act(const Binding& binding);
    void actOnModel(const Binding& binding);
    void toggleTarget();
    void focus();
    glm::ivec2 inFrame(const glm::ivec2& at) const;
    void measure(const Click& click);
    bool actOnMeasures(const Binding& binding);
    RecentViews& recentViews();
    void goToRecent(int step);
    void keepViews();

    Projection projection() const { return walk_.control().camera().projection; }

    /// Returns true if the session ends without the user. It plays a camera path and writes the images, and it ends
    /// after the path, or if the path cannot be played.
    bool isScripted() const { return !options_.path.empty() && !options_.images.empty(); }

    bool isIdle() const { return !scheduler_.needsScene() && !walk_.isUnderWay(); }

    bool comesToRest() const;
    bool isRefining() const;
    void refine();
    void savePictureOnceDone();
    void saveShownPicture();
    void savePictureOf(Shot still);
    QualityLevel wantedQuality() const;
    bool isHurried() const;
    Shot shot(const glm::ivec2& size, bool isStill) const;
    void takePicture();
    bool drawFrame(); // returns whether the scene was drawn
    void drawScene(const glm::ivec2& size);
    void afterScene(const Shot& shot, bool isMeasured);
    OverlayContent content() const;
    void drawWindow(const glm::ivec2& size);

    /// An image of a resting view that the user has requested and that must still be saved. It is saved after its last
    /// refinement, or before the window draws another view.
    struct PictureDue {
        Shot shot; // input at the moment of the request
        std::uint64_t changes = 0;
    };

    ViewerOptions options_;
    ViewSettings settings_;
    gl::Window window_;
    Input input_;
    ImGuiLayer imgui_;
    gl::PictureFill fill_;
    Messages messages_;
    OpenFile file_;
    Walk walk_;
    Steering steering_;
    SectionDrag sectionDrag_;
    RedrawScheduler scheduler_;
    QualityGovernor governor_;
    FrameHistory history_;
    TexelPlot pad_;
    SavedFiles saved_;
    Measuring measuring_;
    std::map<std::string, RecentViews> recent_; // by the model's file
    KeptViews keptViews_ = KeptViews::ofUser();
    std::optional<FrameLog> log_;
    std::optional<FramedModel> framed_;
    Caps caps_;
    double lastFrame_ = 0; // seconds on GLFW's clock
    double lastShown_ = 0; // time of the last drawing of the window, same clock
    double lastWindowMs_ = 0;
    glm::ivec2 drawnFor_{0}; // window size of the last frame
    std::int64_t frameCount_ = 0;
    std::optional<PictureDue> pictureDue_;
    bool savesWindow_ = false;
};

} // namespace gnomon::viewer
