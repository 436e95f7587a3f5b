// What is told over the picture, and what was done there with the mouse.
#pragma once

#include "viewer/input/key_table.h"
#include "viewer/measuring.h"
#include "viewer/messages.h"
#include "viewer/model_cache.h"
#include "viewer/panel/frame_history.h"
#include "viewer/panel/plan_words.h"
#include "viewer/panel/storage_pad.h"
#include "viewer/panel/wire_frames.h"
#include "viewer/scene.h"
#include "viewer/view_settings.h"

#include <functional>
#include <string>

namespace gnomon::viewer {

/// Everything that the overlay tells of.
struct OverlayContent {
    const Scene* scene = nullptr; // null: no model is open
    Camera camera;                // who sees the picture
    const FrameHistory* history = nullptr;
    std::string givenUp; // for the time target; empty: nothing
    bool isExhausted = false;
    Caps caps;
    int mostSamples = 1;                  // frames that a standing picture becomes the mean of
    double flyingSpeed = 0;               // world units a second
    const Measuring* measuring = nullptr; // null: nothing is measured
    bool isFrozen = false;
    bool isRecording = false;
    double playedPart = -1; // below 0: nothing is played
    const std::vector<Message>* messages = nullptr;
    std::optional<BuildStatus> build;
    std::string buildOf;
};

/// What was done with the mouse.
struct OverlayAnswer {
    bool hasChanged = false;     // of the settings
    bool isUnfinished = false;   // there is more to be seen if it is drawn again
    std::vector<Action> actions; // of buttons, value 0
};

} // namespace gnomon::viewer
