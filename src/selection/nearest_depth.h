// How near to the eye anything in view can be, whatever its detail.
#pragma once

#include "selection/cut.h"

namespace gnomon::selection {

/// The least view depth at which `view` can show anything of the model, from the boxes of the finest level's pages that
/// reach into the view: 0 where the eye is among them, infinite where nothing is in view. A surface of a coarser level
/// may lie nearer by its error, which is small beside the depth wherever it is drawn; a margin of a twentieth, in depth
/// and in the view's angles, covers errors up to a twentieth of the image's height.
double nearestDepth(const PageTrees& trees, const DetailView& view);

} // namespace gnomon::selection
