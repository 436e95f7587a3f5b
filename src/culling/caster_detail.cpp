#include "culling/caster_detail.h"

#include "culling/frame_cut.h"

namespace gnomon::culling {

selection::CasterDetail casterDetail(const selection::DetailView& view, const PartitionMap& partition) {
    const shadow::WarpedMap& map = partition.map;
    selection::CasterDetail detail;
    detail.casters = localVolume(partition.casters, view);
    detail.receivers = localVolume(partition.receivers, view);
    detail.receiverNear = partition.receiverNear;
    detail.towardsLight = toWorld(view.basis, map.frame.y);
    selection::TexelWidth& texel = detail.texel;
    texel.axis = toWorld(view.basis, map.frame.z);
    texel.origin = glm::dot(texel.axis, view.eye) + map.zMin;
    texel.depth = map.length;
    texel.kappa = map.kappa;
    texel.width = map.width / partition.resolution.s;
    texel.length = map.length / partition.resolution.t;
    return detail;
}

selection::CasterDetail casterDetail(
    const selection::DetailView& view, const shadow::ShadowMapPartition& partition, int gutter) {
    const shadow::TexelRectangle& rectangle = partition.rectangle;
    const double along = rectangle.width - 2 * gutter;
    const double up = rectangle.height - 2 * gutter;
    const shadow::Resolution texels{1, rectangle.transposed ? up : along, rectangle.transposed ? along : up};
    const shadow::Region& region = partition.region;
    return casterDetail(view, {partition.map, texels, partition.casterVolume, region.volume, region.frustum.near});
}

} // namespace gnomon::culling
