// The data that the user interface over the image shows, and the user's response to it.
#pragma once

#include "viewer/input/key_table.h"
#include "viewer/measuring.h"
#include "viewer/messages.h"
#include "viewer/model_cache.h"
#include "viewer/panel/frame_history.h"
#include "viewer/panel/plan_words.h"
#include "viewer/panel/texel_plot.h"
#include "viewer/panel/wire_frames.h"
#include "viewer/scene.h"
#include "viewer/view_settings.h"

#include <functional>
#include <string>

namespace gnomon::viewer {

/// The data that the user interface over the image shows.
struct OverlayContent {
    const Scene* scene = nullptr; // null: no model is open
    Camera camera;                // camera of the image
    const FrameHistory* history = nullptr;
    std::string reductions; // reductions of the quality governor; empty: none
    bool isExhausted = false;
    Caps caps;
    int maxSamples = 1;                   // number of frames in the mean of a resting image
    double flyingSpeed = 0;               // world units per second
    const Measuring* measuring = nullptr; // null: no measures
    bool isFrozen = false;
    bool isRecording = false;
    double playedPart = -1; // share of the played path; below 0: no path is playing
    const std::vector<Message>* messages = nullptr;
    std::optional<BuildStatus> build;
    std::string buildOf;
};

/// The user's response to the user interface with the mouse.
struct OverlayAnswer {
    bool hasChanged = false;     // a setting has changed
    bool isUnfinished = false;   // another frame would show more
    std::vector<Action> actions; // actions of pressed buttons, with value 0
};

} // namespace gnomon::viewer
