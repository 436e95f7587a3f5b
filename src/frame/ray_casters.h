// What rays from a frame's surfaces towards the light can meet: the casters of the whole frustum, in one volume.
#pragma once

#include "frame/prepared_frame.h"

namespace gnomon::frame {

/// The volume that every ray from a surface in the view to the light stays in; local space.
ConvexVolume rayCasterVolume(const PreparedFrame& frame);

/// What the casters of those rays must be exact enough for.
selection::CasterDetail rayCasterDetail(const PreparedFrame& frame);

} // namespace gnomon::frame
