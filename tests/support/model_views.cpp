#include "tests/support/model_views.h"

#include "hierarchy/validation.h"

#include <cmath>
#include <limits>

namespace gnomon::tests {

namespace {

std::vector<hierarchy::PageInfo> tableOf(const TinyModel& model) {
    std::vector<hierarchy::PageInfo> table;
    for (const hierarchy::Page& page : model.pages)
        table.push_back(hierarchy::describePage(page));
    return table;
}

} // namespace

ModelInMemory::ModelInMemory(const TinyModelOptions& options)
    : model(makeTinyModel(options)), table(tableOf(model)), trees(table, model.summary.grid) {
    for (const hierarchy::Page& page : model.pages)
        all.push_back(&page);
    for (const hierarchy::PageInfo& info : table)
        bounds.add(model.summary.grid.local(info.box));
}

const ModelInMemory& sharedModel() {
    static const ModelInMemory model([] {
        TinyModelOptions options;
        options.gridExponent = 7;
        options.clusterTriangles = 32;
        options.pageGroups = 1;
        options.height = 12;
        options.attributeErrorFrom = 0.5;
        return options;
    }());
    return model;
}

std::size_t ModelInMemory::rootCount() const {
    std::size_t count = 0;
    for (const hierarchy::PageInfo& info : table)
        count += info.maxError == std::numeric_limits<double>::infinity() ? 1 : 0;
    return count;
}

namespace {

glm::dvec3 randomDirection(Random& random) {
    const glm::dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    return glm::normalize(v + glm::dvec3(1e-6));
}

} // namespace

lod::DetailView randomView(Random& random, const Box& bounds) {
    Camera camera;
    const glm::dvec3 t(random.uniform(-0.3, 1.3), random.uniform(0, 3), random.uniform(-0.3, 1.3));
    camera.eye = bounds.min + t * bounds.extent();
    const glm::dvec3 seen(random.unit(), random.unit(), random.unit());
    camera.target = random.below(2) == 0 ? camera.eye + randomDirection(random) : bounds.min + seen * bounds.extent();
    lod::DetailView view;
    view.eye = camera.eye;
    view.basis = cameraBasis(camera);
    view.tanHalfY = std::tan(random.uniform(0.1, 1.2));
    view.tanHalfX = view.tanHalfY * random.uniform(0.5, 2);
    view.heightPixels = random.uniform(50, 2000);
    view.nearestDepth = random.uniform(1e-3, 1);
    return view;
}

std::vector<lod::CasterDetail> randomCasters(Random& random, const lod::DetailView& view) {
    std::vector<lod::CasterDetail> casters(1 + random.below(4));
    double near = random.uniform(0.1, 2);
    const glm::dvec3 towardsLight = randomDirection(random);
    for (lod::CasterDetail& caster : casters) {
        const double far = near * random.uniform(1.5, 8);
        caster.receivers = lod::viewPyramid(view);
        const glm::dvec3& v = view.basis.view;
        caster.receivers.planes.push_back({v, -glm::dot(v, view.eye) - near});
        caster.receivers.planes.push_back({-v, glm::dot(v, view.eye) + far});
        for (const Plane& plane : caster.receivers.planes) // only the planes that face away from the light stay
            if (glm::dot(plane.normal, towardsLight) >= 0) caster.casters.planes.push_back(plane);
        caster.receiverNear = near;
        caster.towardsLight = towardsLight;
        caster.texel.axis = glm::normalize(v - towardsLight * glm::dot(v, towardsLight));
        caster.texel.origin = glm::dot(caster.texel.axis, view.eye);
        caster.texel.depth = far;
        caster.texel.kappa = random.uniform(0, 2);
        caster.texel.width = random.uniform(0, 0.2);
        caster.texel.length = random.uniform(0, 0.2);
        near = far;
    }
    return casters;
}

std::vector<const hierarchy::Page*> randomResidency(Random& random, const ModelInMemory& model) {
    std::vector<const hierarchy::Page*> resident = model.all;
    const double missing = random.unit();
    for (std::size_t page = 0; page < resident.size(); ++page) {
        const bool isRoot = model.table[page].maxError == std::numeric_limits<double>::infinity();
        const double depth = static_cast<double>(page) / static_cast<double>(resident.size()); // coarsest first
        if (!isRoot && random.unit() < missing * depth) resident[page] = nullptr;
    }
    for (std::size_t page = 0; page < resident.size(); ++page) // children follow their parents
        for (const std::uint32_t child : model.table[page].children)
            if (resident[page] == nullptr) resident[child] = nullptr;
    return resident;
}

} // namespace gnomon::tests
