#include "lod/caster_detail.h"

#include "lod/frame_cut.h"

namespace gnomon::lod {

lod::CasterDetail casterDetail(const lod::DetailView& view, const shadow::ShadowMap& map) {
    const shadow::WarpedMap& warped = map.warped;
    const shadow::Resolution texels = map.texels();
    lod::CasterDetail detail;
    detail.casters = localVolume(map.casterVolume, view);
    detail.receivers = localVolume(map.region.volume, view);
    detail.receiverNear = map.region.covered.near;
    detail.towardsLight = toWorld(view.basis, warped.frame.y);
    lod::TexelWidth& texel = detail.texel;
    texel.axis = toWorld(view.basis, warped.frame.z);
    texel.origin = glm::dot(texel.axis, view.eye) + warped.zMin;
    texel.depth = warped.length;
    texel.kappa = warped.kappa;
    texel.width = warped.width / texels.s;
    texel.isLog = warped.rows == shadow::RowSpacing::Logarithmic;
    const double length = texel.isLog ? shadow::rowLength(warped.kappa, warped.length, warped.rows) : warped.length;
    texel.length = length / texels.t;
    return detail;
}

} // namespace gnomon::lod
