// What rays from a frame's surfaces towards the light can meet: the casters of the whole frustum, in one volume.
#pragma once

#include "frame/prepared_frame.h"

namespace gnomon::frame {

/// The volume that every ray from a surface in the view to the light stays in; local space.
ConvexVolume rayCasterVolume(const PreparedFrame& frame);

/// What the casters of a point light must be exact enough for: that of what is seen at all depths within a factor of
/// two, so that what is near asks for detail of what casts there alone.
std::vector<selection::CasterDetail> pointCasterDetails(const PreparedFrame& frame);

/// What the casters of those rays must be exact enough for, where the light is a direction.
selection::CasterDetail rayCasterDetail(const PreparedFrame& frame);

} // namespace gnomon::frame
