#include "shadow/scheme.h"

namespace gnomon::shadow {

namespace {

SchemeMap schemeMap(std::size_t sliceIndex, Face face, const LightFit& fit, const Warp& warp) {
    const double kappa = face == Face::Near ? 0 : kappaOf(warp, fit);
    return {sliceIndex, face, fit, kappa, worstAliasing(fit, kappa)};
}

} // namespace

std::vector<SchemeMap> schemeMaps(const ViewFrustum& frustum, const glm::dvec3& towardsLight, const Scheme& scheme) {
    const std::vector<double> splits = practicalSplits(frustum.near, frustum.far, scheme.slices, scheme.splitLambda);
    std::vector<SchemeMap> maps;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
        const ViewFrustum part = slice(frustum, splits[i], splits[i + 1]);
        const Warp warp = warpOfSlice(scheme.warp, frustum, part);
        if (!scheme.faces) {
            maps.push_back(schemeMap(i, Face::Whole, fitSlice(lightFrame(towardsLight), part), warp));
            continue;
        }
        for (const Face face : sideFaces(frustum, towardsLight))
            maps.push_back(schemeMap(i, face, fitFace(part, towardsLight, face, scheme.bisector), warp));
        if (scheme.nearFace == NearFace::OwnMap)
            maps.push_back(schemeMap(i, Face::Near, fitFace(part, towardsLight, Face::Near, scheme.bisector), warp));
    }
    return maps;
}

double storageFactor(const std::vector<SchemeMap>& maps) {
    double sum = 0;
    for (const SchemeMap& map : maps)
        sum += map.storageFactor();
    return sum;
}

} // namespace gnomon::shadow
