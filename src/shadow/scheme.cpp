#include "shadow/scheme.h"

namespace gnomon::shadow {

namespace {

SchemeMap schemeMap(std::size_t sliceIndex, Face face, LightFit fit, const Warp& warp) {
    fit.rows = rowsOf(warp.rule);
    const double kappa = kappaOfMap(warp, fit, face);
    return {sliceIndex, face, fit, kappa, worstAliasing(fit, kappa), worstShearedAliasing(fit, kappa)};
}

} // namespace

Bisector bisectorOf(const Scheme& scheme) {
    return rowsOf(scheme.warp.rule) == RowSpacing::Logarithmic ? Bisector::NearEdge : scheme.bisector;
}

std::vector<SchemeMap> schemeMaps(const ViewFrustum& frustum, const glm::dvec3& towardsLight, const Scheme& scheme) {
    const std::vector<double> splits = practicalSplits(frustum.near, frustum.far, scheme.slices, scheme.splitLambda);
    const Bisector bisector = bisectorOf(scheme);
    std::vector<SchemeMap> maps;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
        const ViewFrustum part = slice(frustum, splits[i], splits[i + 1]);
        const Warp warp = warpOfSlice(scheme.warp, frustum, part);
        if (!scheme.faces) {
            maps.push_back(schemeMap(i, Face::Whole, fitSlice(lightFrame(towardsLight), part), warp));
            continue;
        }
        for (const Face face : sideFaces(frustum, towardsLight))
            maps.push_back(schemeMap(i, face, fitFace(part, towardsLight, face, bisector), warp));
        if (scheme.nearFace == NearFace::OwnMap)
            maps.push_back(schemeMap(i, Face::Near, fitFace(part, towardsLight, Face::Near, bisector), warp));
    }
    return maps;
}

double storageFactor(const std::vector<SchemeMap>& maps) {
    double sum = 0;
    for (const SchemeMap& map : maps)
        sum += map.storageFactor();
    return sum;
}

double shearedStorageFactor(const std::vector<SchemeMap>& maps) {
    double sum = 0;
    for (const SchemeMap& map : maps)
        sum += map.shearedStorageFactor();
    return sum;
}

} // namespace gnomon::shadow
